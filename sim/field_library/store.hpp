#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "sim/field_library/plan.hpp"
#include "sim/netcdf/resumable_file.hpp"

namespace earshot::field_library {

enum class PositionState : std::uint8_t { kToDo = 0, kDone = 1, kNoWater = 2 };

/// A library on the disk. A position is marked done when its field is on the disk, so that a mark never lies; marks are gathered for a
/// second, because each costs the disk two round trips.
class LibraryStore {
 public:
  /// Takes up the library that was begun under this name, or begins it.
  LibraryStore(const std::filesystem::path& path, const LibraryPlan& plan);
  ~LibraryStore();  ///< marks what was written: an error loses nothing
  LibraryStore(const LibraryStore&) = delete;
  LibraryStore& operator=(const LibraryStore&) = delete;

  /// Whether the same library stands there whole.
  [[nodiscard]] static bool is_finished(const std::filesystem::path& path, const LibraryPlan& plan);

  [[nodiscard]] PositionState state(std::size_t position) const { return static_cast<PositionState>(states_[position]); }
  void write(std::size_t position, std::span<const float> transmission_loss_db);  ///< and marks it done
  void mark(std::size_t position, PositionState state);
  void commit();

 private:
  void write_marks();

  netcdf::ResumableFile file_;
  std::vector<double> states_;
  std::vector<std::size_t> unmarked_;  ///< written, not yet marked
  std::vector<std::size_t> fan_shape_;
  std::chrono::steady_clock::time_point last_flush_{};
};

}  // namespace earshot::field_library
