#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

/// What a file does with the mission's origin, without which there are no latitudes and longitudes.
enum class Origin : std::uint8_t { kUnused, kUsed, kNeeded };

/// A kind of file that a journal is written as.
struct ExportKind {
  const char* option = "";  ///< of the command line
  const char* help = "";
  host::OutputKind output;
  Origin origin = Origin::kUnused;
  /// @param plane  about the mission's origin, where that is known
  std::unique_ptr<Export> (*make)(const std::filesystem::path& path, const std::optional<n2k::LocalPlane>& plane) = nullptr;
};

inline constexpr std::size_t kExportKindCount = 6;
extern const std::array<ExportKind, kExportKindCount> kExportKinds;

}  // namespace earshot::journal
