#pragma once

#include <cstdint>

#include "firmware/core/time.hpp"

namespace earshot::safety {

/// Whether an alarm stands that any of several senders may tell: one that knows nothing of it, and says "none" as long as it lives, takes
/// no other's back.
///
/// What a port told stands until that port takes it back. Told again within kDrop of that, two senders of one port contradict each other,
/// or the sensor is wet now and then: it stands for good. Oracle: StandingAlarm.*
class StandingAlarm {
 public:
  void take(Time arrival, std::uint8_t port, bool is_reported);
  /// A search begins: what stood for good was told on deck, and stands from now on only while somebody tells it.
  void begin();
  [[nodiscard]] bool stands() const { return reported_by_ != 0 || stands_for_good_; }

  /// A drop on a sensor is no leak; two of them within so long are.
  static constexpr Duration kDrop = Duration::seconds(30);

 private:
  Time taken_back_;                ///< the last time
  std::uint32_t reported_by_ = 0;  ///< bit for bit the ports that told it, and did not take it back
  bool was_taken_back_ = false;
  bool stands_for_good_ = false;
};

}  // namespace earshot::safety
