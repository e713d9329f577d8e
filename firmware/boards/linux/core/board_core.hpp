#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "firmware/boards/linux/core/core.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/transport/serial_line.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/serial/cobs.hpp"
#include "firmware/wire/serial/record_frame.hpp"

namespace earshot::board {

/// The runtime on a microcontroller (firmware/boards/cortex_m7) at the other end of a serial line: every input goes there, every turn is
/// made there, and what it says comes back. After construction nothing allocates.
class BoardCore final : public Core {
 public:
  /// Waits for the board, gives it policy, tables and mission, and waits until it is armed.
  /// @param policy, tables  bytes of the files; no tables where the policy needs none
  /// @param patience        with each of its answers; twenty times as long with arming, which makes the decisions of the golden searches
  /// @throws host::BadInput when there is no board, or it refuses them
  BoardCore(host::SerialLine line, const config::Mission& mission, std::span<const std::uint8_t> policy,
            std::span<const std::uint8_t> tables, std::chrono::milliseconds patience);

  /// @return nothing: what becomes of an order only the board knows
  std::optional<messages::CommandOutcome> take(const messages::Input& input) override;
  /// @throws std::runtime_error when the board does not answer, has begun anew, or has lost an input
  [[nodiscard]] runtime::Outputs step(Time now) override;
  /// As it was given to the board: what an operator has tightened since, the board alone knows.
  [[nodiscard]] const config::Mission& mission() const override { return mission_; }

  /// What the board needed, for a person: the longest turn with a decision, and its stack.
  [[nodiscard]] std::string remark() const;

 private:
  void send(Time time, std::string_view channel, std::span<const std::uint8_t> data);
  void send_pieces(std::string_view channel, std::span<const std::uint8_t> file);
  /// @return false: none came in time
  [[nodiscard]] bool receive(wire::FramedRecord& record, std::chrono::milliseconds patience);
  [[nodiscard]] bool receive_report(messages::BoardReport& report);
  void note(const messages::BoardReport& report);
  void put(const wire::FramedRecord& record, runtime::Outputs& outputs);

  host::SerialLine line_;
  std::chrono::milliseconds patience_;
  config::Mission mission_;
  std::uint64_t inputs_ = 0;
  std::array<std::uint8_t, wire::kFrameBytes> frame_{};
  wire::CobsReader reader_{frame_};
  std::array<std::uint8_t, 4096> received_{};
  std::size_t received_size_ = 0;
  std::size_t read_ = 0;  ///< of these
  std::uint64_t frames_refused_ = 0;
  std::uint32_t longest_turn_us_ = 0;
  messages::BoardReport last_{};
};

}  // namespace earshot::board
