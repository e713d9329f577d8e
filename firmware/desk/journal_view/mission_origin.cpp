#include "firmware/desk/journal_view/mission_origin.hpp"

#include <nlohmann/json.hpp>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/journal/journal_name.hpp"

namespace earshot::journal {
namespace {

/// null: it is not there, or no JSON.
nlohmann::json read_summary(const std::filesystem::path& path) {
  try {
    return nlohmann::json::parse(host::read_text(path, host::kJsonFile), nullptr, false);
  } catch (const host::BadInput&) {
    return {};
  }
}

}  // namespace

std::optional<n2k::LocalPlane> plane_beside(const std::filesystem::path& journal) {
  if (journal.filename() != host::kFirstJournal) return std::nullopt;
  const nlohmann::json summary = read_summary(journal.parent_path() / "summary.json");
  const nlohmann::json origin = summary.is_object() ? summary.value("origin", nlohmann::json()) : nlohmann::json();
  if (!origin.is_object()) return std::nullopt;
  const nlohmann::json latitude = origin.value("latitude_deg", nlohmann::json());
  const nlohmann::json longitude = origin.value("longitude_deg", nlohmann::json());
  if (!latitude.is_number() || !longitude.is_number()) return std::nullopt;
  const Result<n2k::LocalPlane> plane =
      n2k::LocalPlane::about({.latitude_deg = latitude.get<double>(), .longitude_deg = longitude.get<double>()});
  return plane.ok() ? std::optional(plane.value()) : std::nullopt;
}

}  // namespace earshot::journal
