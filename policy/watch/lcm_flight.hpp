#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "firmware/host/transport/lcm_endpoint.hpp"
#include "policy/watch/flight_source.hpp"

namespace earshot::watch {

/// A flight by what its vehicle and its devices say on LCM. It sends nothing. What no bus carries is not known of it: the mission, the
/// policy and its tables.
/// Oracle: LcmFlight.*
class LcmFlight final : public FlightSource {
 public:
  /// @throws host::BadInput when the address is none
  explicit LcmFlight(const std::string& url);

  [[nodiscard]] Change take() override;
  [[nodiscard]] report::GrowingFlight& flight() override { return *flight_; }
  void wait(std::chrono::milliseconds most) override;

 private:
  void begin();
  [[nodiscard]] Change take(const wire::Lc02Message& message);

  std::string url_;
  host::LcmEndpoint endpoint_;
  std::unique_ptr<report::GrowingFlight> flight_;
  std::uint32_t next_number_ = 0;
  std::chrono::steady_clock::time_point next_refresh_;  ///< of the network's interfaces
};

}  // namespace earshot::watch
