// A sensor of one's own, over LCM: an SNR twice a second.   usage: my_sensor LCM_URL SNR_DB
#include <chrono>
#include <string>
#include <thread>

#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

int main(int, char** argv) {
  using namespace earshot;
  host::LcmEndpoint bus(host::parse_lcm_url(argv[1]), {});
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(500))) {
    const auto utc = std::chrono::system_clock::now().time_since_epoch();  // the end of the interval that it was measured over
    const messages::SnrMeasurement measured{.time = {std::chrono::duration_cast<std::chrono::microseconds>(utc).count()},
                                            .snr = Decibels{std::stod(argv[2])}};
    (void)bus.publish(wire::kSnrEstimateChannel, wire::Encoded(measured).bytes());
  }
}
