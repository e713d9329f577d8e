#pragma once

#include <cstdint>
#include <filesystem>

#include "firmware/authority/mission_manifest.hpp"
#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// What a vehicle flew last, as its counter file says: by it an older mission is refused.
/// @throws BadInput when there is no such file, or it is damaged: nothing is flown then, because anything might have been flown before
/// Oracle: MissionCounter.*
[[nodiscard]] authority::MissionManifest read_flown_last(const std::filesystem::path& counter_file);

/// A person sets a counter no higher: above it lie more numbers than missions will ever use.
inline constexpr std::int64_t kHighestSetCounter = std::int64_t{1} << 62U;

/// Makes the counter file of a vehicle that has none yet; one that is there stays.
/// @param counter  of the last mission that is to be refused; 0: none has flown
/// @throws BadInput naming the file
void begin_counter(const std::filesystem::path& counter_file, std::uint64_t counter);

/// Refuses from now on all missions up to `counter`, which lies above what has flown: for who is to go on far above that.
/// @throws BadInput, FolderInUse as MissionCounter does
void raise_counter(const std::filesystem::path& counter_file, std::uint64_t counter);

/// Changes nothing, and waits for nobody. @throws BadInput when a mission that flies could not be recorded in it
void require_recordable(const std::filesystem::path& counter_file);

/// The counter file of a vehicle that is about to fly, held as long as this is kept: of two programs one flies.
class MissionCounter {
 public:
  /// @throws BadInput as read_flown_last(), and when it cannot be written; FolderInUse when another program holds a counter in its folder
  explicit MissionCounter(std::filesystem::path counter_file);

  [[nodiscard]] const authority::MissionManifest& flown_last() const { return flown_last_; }
  /// Replaces the file whole, and brings it to the disk: a mission flies only after what it replaces can no longer be flown.
  /// @throws BadInput naming the file, which is then what it was
  void record(const authority::MissionManifest& manifest);

 private:
  std::filesystem::path file_;
  FileDescriptor lock_;
  authority::MissionManifest flown_last_;
};

}  // namespace earshot::host
