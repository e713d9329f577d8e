#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <optional>

#include "firmware/desk/journal_view/export_kinds.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

/// What is to be made of a journal; with none of the files its timeline is printed.
struct ViewOptions {
  std::filesystem::path journal;
  std::array<std::optional<std::filesystem::path>, kExportKindCount> files{};  ///< in the order of kExportKinds
  std::optional<n2k::LocalPlane> plane = std::nullopt;  ///< about the mission's origin; nothing: that of a flight's summary
  bool follow = false;                                  ///< the mission may still be under way: wait for its end
  std::chrono::seconds wait{60};                        ///< likewise for its beginning
  host::Replace replace = host::Replace::kOwnKind;
};

/// Prints the timeline or writes the files, and says on standard error what the journal lacks.
/// @return kDone; kIncomplete when it lacks something; kLost when standard output takes no more; kStopped by a signal (follow)
/// @throws host::BadInput when there is no record in the journal, or a file may not be or cannot be written: then none is.
[[nodiscard]] int view(const ViewOptions& options);

}  // namespace earshot::journal
