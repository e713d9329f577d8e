// A port of one's own: a vehicle on a serial line that speaks in words. From it come
//   NAV NORTH_M EAST_M DEPTH_M HEADING_DEG SPEED_MPS     where it is now, at least once in five seconds
//   START                                                its operator asks for the search
// and to it goes, with every turn of a search,  SET HEADING_DEG SPEED_MPS DEPTH_M.
#pragma once

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <numbers>
#include <string>
#include <system_error>

#include "firmware/boards/linux/port/port.hpp"

class SerialPort final : public earshot::board::Port {
 public:
  SerialPort(std::uint8_t index, const std::string& line)
      : Port(index, {earshot::host::Role::kNavigation, earshot::host::Role::kOperator, earshot::host::Role::kAutopilot}),
        name_(line),
        file_(open(line.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (file_ < 0) throw std::system_error(errno, std::generic_category(), line);
    termios settings{};
    if (tcgetattr(file_, &settings) == 0) {
      cfmakeraw(&settings);
      (void)tcsetattr(file_, TCSANOW, &settings);
    }
    report_.link_up = true;
  }
  ~SerialPort() override { (void)close(file_); }

  /// Whole lines, without waiting and without asking for memory.
  void collect(earshot::board::Clock& clock, earshot::board::InputSink& sink) override {
    for (char c = 0; read(file_, &c, 1) == 1;) {
      if (c != '\n' && length_ + 1 < text_.size()) {
        text_[length_++] = c;
      } else if (c == '\n') {
        text_[length_] = '\0';
        length_ = 0;
        ++(take(clock.now(), sink) ? report_.received : report_.malformed);
      }
    }
  }

  std::uint64_t publish(earshot::Time /*now*/, const earshot::runtime::Outputs& outputs) override {
    if (!outputs.setpoint) return 0;
    std::array<char, 80> line{};
    const int size = std::snprintf(line.data(), line.size(), "SET %.1f %.2f %.1f\n", outputs.setpoint->heading.value / kDegree,
                                   outputs.setpoint->speed.value, outputs.setpoint->depth.value);
    if (write(file_, line.data(), static_cast<std::size_t>(size)) == size) return 1;
    ++report_.unsent;
    return 0;
  }

  [[nodiscard]] int file_descriptor() const override { return file_; }
  [[nodiscard]] earshot::board::PortWords words() const override { return {.label = "vehicle, serial line " + name_}; }

 private:
  static constexpr double kDegree = std::numbers::pi / 180.0;

  /// @return whether the line says something that a vehicle says
  bool take(earshot::Time now, earshot::board::InputSink& sink) {
    using namespace earshot;
    if (std::string_view(text_.data()) == "START") {
      sink.take(
          index(),
          messages::OperatorCommand{
              .time = now, .expiry = now + Duration::seconds(30), .issuer = 1, .number = ++orders_, .order = messages::Order::kStart});
      return true;
    }
    double north_m = 0.0;
    double east_m = 0.0;
    double depth_m = 0.0;
    double heading_deg = 0.0;
    double speed_mps = 0.0;
    if (std::sscanf(text_.data(), "NAV %lf %lf %lf %lf %lf", &north_m, &east_m, &depth_m, &heading_deg, &speed_mps) != 5) return false;
    sink.take(index(), messages::Navigation{.time = now,  // this line bears no date: what it says is valid when it comes
                                            .position = {.north = Meters{north_m}, .east = Meters{east_m}},
                                            .depth = Meters{depth_m},
                                            .heading = Radians{heading_deg * kDegree},
                                            .speed = MetersPerSecond{speed_mps}});
    return true;
  }

  std::string name_;
  int file_;
  std::array<char, 200> text_{};
  std::size_t length_ = 0;
  std::uint32_t orders_ = 0;
};
