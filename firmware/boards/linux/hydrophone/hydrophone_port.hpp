#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/boards/linux/hydrophone/hydrophone_processor.hpp"
#include "firmware/boards/linux/hydrophone/hydrophone_receiver.hpp"
#include "firmware/boards/linux/port/port.hpp"

namespace earshot::board {

/// A hydrophone's samples, taken and listened to in threads of its own: none of them enters the loop, which takes what was heard.
/// Its report counts samples of one channel where other ports count messages. Owns the receiver of samples and the processor that listens.
class HydrophonePort final : public Port, public SoundListener {
 public:
  /// @param hearing  what is listened for; none: samples are counted only
  /// @throws std::system_error, std::invalid_argument as HydrophoneReceiver does.
  HydrophonePort(std::uint8_t index, const host::PortSettings& settings, const std::optional<detector::SoundSettings>& hearing,
                 WakesFor wakes, host::IfMissing if_missing = host::IfMissing::kRefuse);

  void collect(Clock& clock, InputSink& sink) override;
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& /*outputs*/) override { return 0; }
  [[nodiscard]] int file_descriptor() const override { return processor_.file_descriptor(); }
  [[nodiscard]] messages::PortReport report() const override;
  [[nodiscard]] std::size_t memory() const override { return sizeof *this + receiver_.memory(); }
  [[nodiscard]] PortWords words() const override;
  [[nodiscard]] FurtherDuties further_duties() override { return {.sound_listener = this}; }
  void note_speed(MetersPerSecond speed) override { processor_.note_speed(speed); }
  [[nodiscard]] std::uint64_t blocks_heard() const override { return processor_.blocks_heard(); }

 private:
  [[nodiscard]] std::string remark() const;

  std::string name_;
  std::string address_;
  std::string hears_;  ///< in words; empty: nothing
  HydrophoneProcessor processor_;
  HydrophoneReceiver receiver_;  ///< after what it uses
};

}  // namespace earshot::board
