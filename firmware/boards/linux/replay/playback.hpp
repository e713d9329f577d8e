#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/boards/linux/replay/beginning.hpp"
#include "firmware/boards/linux/turn/turn_memory.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/journal/record_ring.hpp"
#include "firmware/messages/journal_records.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::board {

/// The runtime asserts that time is not negative, and adds to it.
/// @throws host::BadInput naming the record that bears a date which no clock of Earshot gives.
void require_possible_date(const std::filesystem::path& journal, const host::JournalRecord& record);

/// A journal given to a fresh runtime again, record by record: its inputs are taken, and its outputs compared with what the runtime says.
class Playback {
 public:
  /// An output of the last turn that is not in the journal.
  struct Unwritten {
    std::string_view channel;
    wire::Encoded message;
    host::Priority priority;
    Time time;  ///< of its turn, which every record of it bears
  };
  /// A record that the runtime does not give again, byte for byte; or a closing record that tells of another end.
  struct Difference {
    std::uint32_t record = 0;  ///< its number
    std::string channel;
    Time time;
    std::vector<std::uint8_t> data;  ///< its message, as it stands in the journal
    std::optional<Unwritten> now;    ///< what the runtime says there; nothing: that is no place for an output
  };

  /// @param from_step  outputs are compared from the turn on that decides this step; what stands before it is given to the runtime alone
  /// @throws host::BadInput when the file cannot be read, does not begin as read_beginning() wants it, or this build cannot fly them.
  explicit Playback(const std::filesystem::path& journal, std::uint32_t from_step = 0);

  /// One record more. False: the end, a difference or a gap. @throws host::BadInput as require_possible_date()
  [[nodiscard]] bool next();
  /// The last record of a journal that was ended in order, wherever the playback stopped.
  [[nodiscard]] std::optional<messages::ClosingRecord> closing();
  /// Reads the file to its end. @return how many records stand behind the one that ends the journal: another journal's, or forged ones
  [[nodiscard]] std::size_t records_behind_end();

  [[nodiscard]] const Flown& flown() const { return flown_; }
  [[nodiscard]] const host::JournalReader& file() const { return file_; }
  [[nodiscard]] const std::optional<Difference>& difference() const { return difference_; }
  /// Number of the first record that is missing: damaged, or a full or slow disk did not take it.
  [[nodiscard]] std::optional<std::uint32_t> gap() const { return gap_; }
  [[nodiscard]] std::uint32_t next_number() const { return next_number_; }
  [[nodiscard]] const TurnMemory& memory() const { return memory_; }
  /// Of the last turn.
  [[nodiscard]] const runtime::Outputs& outputs() const { return outputs_; }
  /// Of the last turn, whose journal may end in the middle.
  [[nodiscard]] std::vector<Unwritten> unwritten() const {
    return {expected_.begin() + static_cast<std::ptrdiff_t>(compared_), expected_.end()};
  }
  [[nodiscard]] std::size_t turns() const { return turns_; }
  [[nodiscard]] std::size_t decisions() const { return decisions_; }
  /// The runtime has made the decision from which on outputs are compared.
  [[nodiscard]] bool is_comparing() const { return is_comparing_; }
  /// The runtime, as it was then.
  [[nodiscard]] std::unique_ptr<runtime::Runtime> release() { return std::move(runtime_); }

 private:
  void begin();
  [[nodiscard]] bool take(const host::JournalRecord& record);
  void step(Time now);
  /// Of the last turn nothing is left to be found in the journal.
  [[nodiscard]] bool is_compared() const { return compared_ == expected_.size(); }
  [[nodiscard]] bool is_as_expected(const host::JournalRecord& record);
  /// Whether the closing record says how the mission stood after its last turn.
  void compare_end(const host::JournalRecord& record);

  std::filesystem::path path_;
  host::JournalReader file_;
  std::uint32_t from_step_;
  bool is_comparing_ = from_step_ == 0;
  host::JournalRecord record_;
  Flown flown_;
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  TurnMemory memory_;
  runtime::Outputs outputs_;
  std::vector<Unwritten> expected_;  ///< what the last turn says, in the order of the journal
  std::size_t compared_ = 0;         ///< so many of them are in the journal
  std::optional<Difference> difference_;
  std::optional<std::uint32_t> gap_;
  std::optional<messages::ClosingRecord> closing_;
  std::uint32_t next_number_ = 0;
  std::size_t turns_ = 0;
  std::size_t decisions_ = 0;
};

}  // namespace earshot::board
