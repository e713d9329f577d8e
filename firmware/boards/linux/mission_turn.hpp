#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/core/core.hpp"
#include "firmware/boards/linux/core/order_gate.hpp"
#include "firmware/boards/linux/event_log/event_log.hpp"
#include "firmware/boards/linux/outage/safety_log.hpp"
#include "firmware/boards/linux/port/port.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/boards/linux/replay/resume.hpp"
#include "firmware/boards/linux/service/service_manager.hpp"
#include "firmware/boards/linux/turn/turn_memory.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// By what a mission is flown.
struct FlownWith {
  std::span<const std::uint8_t> policy;  ///< bytes of the .policy file
  std::span<const std::uint8_t> tables;  ///< bytes of the .tables file; none where the policy needs none
  std::string_view build;                ///< version and commit of this program
};

/// One turn of the decision loop: what the ports bring is journalled and given to the runtime in the order in which it comes; the call
/// makes the step, journals what comes out, and gives it to the ports.
///
/// In the journal a turn is: its inputs, each with its arrival; then set-point, decision and acknowledgements, if there are any; then
/// health, always, with the turn's time. With the mission, the policy and its tables at its beginning the journal thus holds all that the
/// runtime was ever given: whoever takes the same inputs and steps at every health record gets every output again, bit for bit. A journal
/// that its disk does not take is reported as Earshot's own port (kOwnPort): its link is down. Commands and what steered the vehicle weigh
/// more than streams: on a full disk they are lost last (host::Priority).
class MissionTurn final : public InputSink {
 public:
  /// All four must outlive it.
  MissionTurn(Core& core, PortSet& ports, host::Journal& journal, Clock& clock)
      : core_(core), ports_(ports), journal_(&journal), clock_(clock) {}
  /// Of a vehicle that must be commanded though its journal cannot be written: nothing is journalled.
  MissionTurn(Core& core, PortSet& ports, Clock& clock) : core_(core), ports_(ports), clock_(clock) {}

  /// Writes the journal's first three records, which say what is flown. To be called before anything else.
  /// @return the checksum of the first of them, which marks this journal among all
  std::uint32_t record_mission(const config::Mission& mission, const FlownWith& with);

  /// In place of record_mission(): goes on where another process ended, whose journal is this one's now, and whose runtime this one has.
  void go_on_after(const Resumption& before, std::string_view build);

  /// From now on what a turn says is in the journal's file before it is sent: who resumes from the journal after a crash has forgotten
  /// nothing that anybody heard. What a power cut must not take either, where the journal survives one, is on the disk before it is sent:
  /// obeyed commands (without this, too, and for a tenth of a second at most), changes of state, rules that begin or cease to act. A
  /// set-point that a power cut took is followed by the next.
  /// @param patience  with a slow disk
  void write_ahead(std::chrono::milliseconds patience) {
    is_ahead_always_ = true;
    patience_ = patience;
  }

  /// From now on what must not be forgotten of a turn is in the safety record before the turn is sent. What no disk takes within the
  /// patience of write_ahead(), or a second as long as no set-point has left, is obeyed all the same; who ordered it is told that it is not
  /// durable (CommandOutcome::kObeyedNotDurable), and so does health, where this computer's own port is down. @param safety  must outlive
  /// it
  void keep_safe(SafetyLog& safety) { safety_ = &safety; }

  /// From now on every turn is told to a person, too. @param event_log  must outlive it
  void report_to(EventLog& event_log);
  /// From now on the service manager hears of every turn. It must outlive this.
  void report_to(ServiceManager& manager) { manager_ = &manager; }
  /// From now on a turn that finds this set clears it, and begins a new part of the journal. It must outlive this.
  void begin_parts_when(std::atomic<bool>& is_asked_for) { is_part_asked_for_ = &is_asked_for; }
  /// This program is told to stop: an abort from now on is its own.
  void note_program_stop();

  void take(std::uint8_t port, const Value& value) override;
  void report_detection(std::uint8_t port, const messages::SoundDetection& detection) override;
  void report_chain(std::uint8_t port, const HeardChain& chain) override;
  void report_trouble(std::uint8_t port, BusTrouble trouble, bool is_there) override;
  void report_order_trouble(std::uint8_t port, OrderTrouble trouble) override;

  runtime::Outputs operator()();
  /// Sends what the last turn said: the process that made it may not have come to it.
  runtime::Outputs send_again();
  /// No turn follows, or the last one failed: what has come since then stands in the journal, too.
  void end();

  /// Of the last turn; of a mission that goes on, before its first, what the process before said last.
  [[nodiscard]] const runtime::Outputs& outputs() const { return outputs_; }
  /// Whether something has come since the last turn that is to be answered at once, where arrivals make turns: a fix, or an order.
  [[nodiscard]] bool is_called() const { return is_called_; }
  /// Whether another process commands the vehicle by now, because this one hung: what the last turn said was not sent.
  [[nodiscard]] bool is_overtaken() const { return safety_ != nullptr && safety_->is_overtaken(); }
  /// Whether an ABORT or a leak has come since the last turn: for these none waits.
  [[nodiscard]] bool is_urgent() const { return memory_.is_urgent; }
  /// Fixes taken so far, but for those without a date that the clock knows.
  [[nodiscard]] std::uint64_t navigation_taken() const { return memory_.navigation_taken; }
  [[nodiscard]] std::uint64_t snr_taken() const { return memory_.snr_taken; }
  /// The time of the last turn or input.
  [[nodiscard]] Time last() const { return memory_.last; }

 private:
  /// The mission clock's time; it never goes back, though a clock were read by several.
  [[nodiscard]] Time now();
  /// @return whether the mission is in another state than its journal said last
  bool record(Time now, const runtime::Outputs& outputs);
  /// The journal's trouble is an input like a port's: it stands in the health, and a replay gives it again.
  void report_journal(Time now);
  /// So is a set-point that no port could send.
  void report_mute();
  void record_trouble(std::uint8_t port, BusTrouble trouble, bool is_there);
  void write_ahead_of(const runtime::Outputs& outputs, bool is_new_state);
  [[nodiscard]] std::chrono::milliseconds patience_with_record() const;
  void append(const messages::Input& input, messages::CommandOutcome outcome);
  /// The inputs of a core that says at its step what became of orders: in the journal they stand before what that step says.
  /// @param acknowledgements  of that step; null: there was none
  void append_held(const runtime::Acknowledgements* acknowledgements);
  void append(Time time, std::string_view channel, std::span<const std::uint8_t> data, host::Priority priority);
  /// What the ports are told of a turn that no disk has: the journal, and who plays it back, know what the runtime said.
  [[nodiscard]] const runtime::Outputs& as_published(bool is_durable);

  static constexpr std::size_t kMostHeld = 256;  ///< inputs of a turn; full: journalled as if their orders were obeyed

  Core& core_;
  PortSet& ports_;
  host::Journal* journal_ = nullptr;
  Clock& clock_;
  TurnMemory memory_;
  OrderGate gate_;
  FixedVector<messages::Input, kMostHeld> held_;  ///< for append_held()
  bool is_mute_ = false;                          ///< the last turn's set-point could not be sent
  Time journal_up_due_;                           ///< not before is it told that the disk takes the journal again
  runtime::Outputs outputs_;                      ///< of the last turn
  runtime::Outputs published_;                    ///< likewise, where it was told otherwise
  bool is_called_ = false;
  bool is_ahead_always_ = false;
  std::chrono::milliseconds patience_{100};
  std::atomic<bool>* is_part_asked_for_ = nullptr;
  SafetyLog* safety_ = nullptr;
  ServiceManager* manager_ = nullptr;
  EventLog* event_log_ = nullptr;
};

}  // namespace earshot::board
