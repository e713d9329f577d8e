// A vehicle that follows Earshot's set-points over CAN (NMEA 2000). How to run it: ../connect_your_autopilot.md

#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "firmware/host/transport/can_socket.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"

using namespace earshot;

int main(int argc, char** argv) try {
  if (argc != 2) throw std::invalid_argument("usage: autopilot_over_can INTERFACE");
  const n2k::LocalPlane plane = n2k::LocalPlane::about({.latitude_deg = 38.5, .longitude_deg = -28.0}).value();  // the mission's [origin]
  host::CanSocket bus(argv[1]);
  n2k::SetpointReceiver receiver;
  messages::Navigation vehicle;
  bool is_released = false;
  vehicle.position = {.north = Meters{12'500}, .east = Meters{12'500}};  // the middle of the mission's area
  for (auto last = std::chrono::steady_clock::now();; std::this_thread::sleep_for(std::chrono::milliseconds(100))) {
    messages::Setpoint setpoint;
    for (n2k::Frame frame; bus.receive(frame) == Status::kOk;) {
      if (receiver.accept(frame, setpoint) != Status::kOk) continue;
      vehicle.heading = setpoint.heading;  // this vehicle obeys at once; here an autopilot would steer
      vehicle.speed = setpoint.speed;
      vehicle.depth = setpoint.depth;
      if (setpoint.release_weight && !std::exchange(is_released, true)) std::cout << "releases its drop weight" << std::endl;
    }
    const auto now = std::chrono::steady_clock::now();
    const double travelled_m = vehicle.speed.value * std::chrono::duration<double>(now - last).count();
    vehicle.position.north += Meters{travelled_m * std::cos(vehicle.heading.value)};
    vehicle.position.east += Meters{travelled_m * std::sin(vehicle.heading.value)};
    last = now;
    n2k::NavigationFrames frames;
    if (n2k::compose_navigation(vehicle, plane, n2k::kVehicleAddress, frames) != Status::kOk) continue;
    for (const n2k::Frame& frame : frames) {
      if (bus.send(frame) != Status::kOk) std::cerr << "autopilot_over_can: a frame could not be sent\n";
    }
    if (!bus.is_up()) (void)bus.reopen();
  }
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 2;
}
