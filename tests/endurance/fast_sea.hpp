#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/clock/host_mission_clock.hpp"
#include "firmware/boards/linux/port/port.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::endurance {

/// A host's clocks that run as fast as they are read.
class FastHost final : public board::HostClock {
 public:
  [[nodiscard]] Time utc() const override { return Time{1'795'000'000'000'000} + running_; }
  [[nodiscard]] Duration monotonic() const override { return running_; }
  void advance(Duration by) { running_ = running_ + by; }

 private:
  Duration running_ = Duration::seconds(5000);
};

/// The clock of a mission at sea, but that waiting takes no time: first until what the senders say once a period arrives, then until the
/// turn.
class FastClock final : public board::Clock {
 public:
  static constexpr Duration kHeard = Duration::milliseconds(-50);  ///< from a turn to what is heard before it

  explicit FastClock(FastHost& host) : host_(host), clock_(host) {}

  [[nodiscard]] Time now() override { return clock_.now(); }
  [[nodiscard]] Time mission_time_of(Time utc) override { return clock_.mission_time_of(utc); }
  [[nodiscard]] Time arrival_of(Time utc) override { return clock_.arrival_of(utc); }
  [[nodiscard]] Wake wait(const Awaited& awaited) override;
  [[nodiscard]] bool answered(const runtime::Outputs& outputs, std::uint64_t sent) override { return clock_.answered(outputs, sent); }

 private:
  FastHost& host_;
  board::HostMissionClock clock_;
};

/// What a vehicle goes through while it is out; from the beginning.
struct Voyage {
  Duration period;    ///< between two turns
  Duration start;     ///< an operator gives START
  Duration complete;  ///< COMPLETE
  Duration abort;     ///< ABORT
  Duration end;
  Duration between_orders;  ///< he gives the last one again as a new one
};

/// What must have come of it, counted by who sent it.
struct Sent {
  std::uint64_t inputs = 0;
  messages::Counters refused;  ///< but for set-points, which nobody sends
  std::uint64_t commands = 0;
};

/// Everything around the runtime at once, in memory: navigation, hydrophone, operators, and a vehicle that does at once what it is told.
/// Most of what it says is right; some is wrong in each way that there is, and now and then its link is down.
class FastSea final : public board::Port {
 public:
  /// @param stop  set at its end
  FastSea(std::uint8_t index, const Voyage& voyage, NorthEast place, Time began, std::atomic<bool>& stop);

  void collect(board::Clock& clock, board::InputSink& sink) override;
  std::uint64_t publish(Time now, const runtime::Outputs& outputs) override;
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] board::PortWords words() const override { return {.label = "a sea in memory"}; }

  [[nodiscard]] const Sent& sent() const { return sent_; }

 private:
  template <class Value>
  void send(board::InputSink& sink, const Value& value);
  void send_bad(board::InputSink& sink, Time now);
  void send_orders(board::InputSink& sink, Time now);
  void send_bad_order(board::InputSink& sink, Time now);
  void order(board::InputSink& sink, Time now, messages::Order order);
  void sail();

  Voyage voyage_;
  Time began_;
  Time next_;               ///< when the senders speak again
  std::uint64_t turn_ = 0;  ///< periods since the beginning
  messages::Navigation fix_;
  messages::OperatorCommand last_order_;
  Time next_order_;
  std::atomic<bool>& stop_;
  std::uint64_t bad_orders_ = 0;
  Sent sent_;
};

}  // namespace earshot::endurance
