#pragma once

#include <filesystem>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"
#include "sim/apps/fly/flight_plan.hpp"

namespace earshot::fly {

/// The folder in which people find a flight, held against other flights. A flight writes in a folder within it, and replaces an earlier one
/// whole or not at all:
///
///   FOLDER/unfinished-flight   the flight under way, and what is left of one that was cut off (the next is then unfinished-flight-2)
///   FOLDER/finished-flight     only while a whole flight's files are moving up, summary.json last; a cut there is made good by the next
class FlightFolder {
 public:
  /// Makes the folder if it is missing.
  /// @throws host::FolderInUse naming who writes there, host::BadInput for a full disk, naming a journal from sea, or a file that is no
  /// flight's where no earlier flight lies, std::system_error
  explicit FlightFolder(std::filesystem::path folder);
  /// What it made and nobody has written into is gone again.
  ~FlightFolder();
  FlightFolder(const FlightFolder&) = delete;
  FlightFolder& operator=(const FlightFolder&) = delete;

  /// Where the flight writes; whoever writes makes it.
  [[nodiscard]] const std::filesystem::path& unfinished() const { return unfinished_; }
  /// The flight is whole: its files, brought to the disk, take the place of an earlier one's.
  /// @throws host::FolderInUse naming who writes a journal there by now, std::system_error
  void keep();

 private:
  void move_up();

  std::filesystem::path folder_;
  std::filesystem::path first_made_;  ///< the topmost folder that was missing; empty when none was
  std::filesystem::path unfinished_;
  host::FileDescriptor lock_;
};

/// "what there is of it is in FOLDER", and that the disk is full where it has no room for a flight to go on.
[[nodiscard]] std::string place_of_rest(const std::filesystem::path& unfinished);

/// What a flight leaves in its folder takes the place of whatever bears that name there.
/// @param recording  that is heard; empty: none
/// @throws host::BadInput naming both when that is one of the files that the flight is made of
void require_left_alone(const FlightPlan& plan, const std::filesystem::path& mission, const std::filesystem::path& recording,
                        const std::filesystem::path& folder);

}  // namespace earshot::fly
