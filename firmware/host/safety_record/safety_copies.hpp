#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/safety_record/safety_record.hpp"

namespace earshot::host {

/// Another process flies with one of the copies; the message says which.
class RecordInUse : public BadInput {
 public:
  RecordInUse(const std::string& holder, bool is_killed) : BadInput(holder), is_killed_(is_killed) {}

  /// It flies no more: it has been killed, and its files are not closed yet.
  [[nodiscard]] bool is_killed() const { return is_killed_; }

 private:
  bool is_killed_;
};

/// A copy of the record.
struct SafetyCopy {
  std::filesystem::path file;
  bool survives_power_cut = true;  ///< false: it is in memory (tmpfs), which a disk's sickness does not reach, and a crash leaves alone
};

/// Whether a copy that another process has marked as its own is refused, or read, and written, all the same.
enum class Claim { kNeeded, kWaived };

/// All copies of a vehicle's safety record. Each is written by a thread of its own, so that a disk which hangs holds up neither the turn
/// nor the other copies; one that does not take the record is tried again ten times a second. Where no thread can be had, whoever gives a
/// record writes it. A copy that is removed, replaced or cut in flight is made anew with the next record. Nothing allocates after the
/// construction, but prepare(), kept() and complaints().
/// Oracle: SafetyCopies.*
class SafetyCopies {
 public:
  /// Reads what is there. @param owner  whose records count, and whose are written
  /// @throws RecordInUse; std::system_error where it cannot be told whether a copy is there
  explicit SafetyCopies(const std::vector<SafetyCopy>& copies, const RecordOwner& owner = {}, Claim claim = Claim::kNeeded);
  ~SafetyCopies();
  SafetyCopies(const SafetyCopies&) = delete;
  SafetyCopies& operator=(const SafetyCopies&) = delete;

  /// Of all copies, when this was made: the record that says how this vehicle stands (newest_of()). Nothing: there is none.
  [[nodiscard]] const std::optional<SafetyRecord>& found() const;
  /// Likewise, there was a file that holds no whole record, or that cannot be read or believed, unless it is of another vehicle.
  [[nodiscard]] bool is_damaged() const;
  /// The one that was given last; before any was, the one that was found.
  [[nodiscard]] std::optional<SafetyRecord> newest() const;
  /// Copies that were there and do not count, and why; for a person.
  [[nodiscard]] const std::vector<std::string>& left_out() const;
  /// What is kept beside that record; empty: all copies of it are damaged.
  [[nodiscard]] std::vector<std::uint8_t> kept() const;

  /// Before a flight begins: makes the files that are not there, with all the space that they will ever need, and what is to be kept in
  /// them. A copy that this cannot do for is tried again with every record.
  void prepare(std::span<const std::uint8_t> kept);

  /// Where the program may open no more files, and needs one more than a further copy: gives up the last copy that has one, for good, so
  /// that it takes no record any more. False: only one has a file.
  bool give_up_one();

  /// Gives the record to all copies. @param record  its sequence is given here
  /// @param patience  with slow disks
  /// @return as is_durable()
  bool write(const SafetyRecord& record, std::chrono::milliseconds patience);
  /// Likewise one that says nothing new but its clocks, and for which nobody waits.
  void stamp(const SafetyRecord& record);
  /// What was written last is in a copy that survives a power cut by now.
  [[nodiscard]] bool is_durable() const;
  /// Another process has gone on with the flight: it writes the record, and commands the vehicle.
  [[nodiscard]] bool is_overtaken() const;
  /// The copies that have not taken it; empty: all have.
  [[nodiscard]] std::string complaints() const;

 private:
  struct Writers;
  std::unique_ptr<Writers> writers_;
};

}  // namespace earshot::host
