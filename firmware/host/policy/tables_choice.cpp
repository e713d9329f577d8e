#include "firmware/host/policy/tables_choice.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".tables";

std::vector<fs::path> tables_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == kExtension) files.push_back(entry.path());
  if (files.empty()) throw BadInput(folder.string() + ": holds no ocean tables (" + kExtension + ")");
  std::ranges::sort(files);
  return files;
}

/// How many times the one is the other; 1 for the same.
double ratio(double a, double b) {
  return std::max(a / b, b / a);
}

/// How far tables are from what they were made for: depth goes before frequency.
std::pair<double, double> distance(const policy::OceanTables& tables, const policy::SearchedSound& sound) {
  return {ratio(tables.receiver_depth.value, sound.vehicle_depth.value), ratio(tables.frequency.value, sound.frequency.value)};
}

std::string written(double number) {
  return significant(number, 10);
}

/// "20 Hz at 30, 100, 300 m as far as 35400 m; 35 Hz at ..."
std::string all_there_are(std::span<const TablesFile> files) {
  std::map<std::pair<double, double>, std::set<double>> depths;  // by frequency and reach
  for (const TablesFile& file : files)
    depths[{file.tables->frequency.value, policy::reach(*file.tables).value}].insert(file.tables->receiver_depth.value);
  std::string text;
  const char* between = "";
  for (const auto& [kind, of_kind] : depths) {
    text += std::exchange(between, "; ") + written(kind.first) + " Hz";
    const char* before = " at ";
    for (const double depth : of_kind) text += std::exchange(before, ", ") + written(depth);
    text += " m as far as " + written(kind.second) + " m";
  }
  return text;
}

std::string complaint(std::span<const TablesFile> files, const policy::SearchedSound& sound) {
  return " is listened to at " + written(sound.frequency.value) + " Hz, " + written(sound.vehicle_depth.value) + " m deep, " +
         written(sound.furthest.value) + " m far; none of the tables are of that, but " + all_there_are(files) + " (depths within " +
         written(100.0 * policy::kDepthTolerance) + " %, frequencies within " + written(100.0 * policy::kFrequencyTolerance) +
         " %); earshot tables makes others, and earshot init --depth-m M --frequency-hz F a search with a README on how to do it";
}

}  // namespace

std::vector<TablesFile> read_tables_files(std::span<const fs::path> named) {
  std::vector<TablesFile> files;
  const auto read = [&files](const fs::path& path) {
    std::vector<std::uint8_t> bytes = read_tables_bytes(path);
    std::unique_ptr<policy::OceanTables> tables = tables_from(bytes, path);
    files.push_back({.path = path, .bytes = std::move(bytes), .tables = std::move(tables)});
  };
  for (const fs::path& name : named) {
    if (!fs::is_directory(name)) {
      read(name);
      continue;
    }
    for (const fs::path& path : tables_in(name)) read(path);
  }
  return files;
}

const TablesFile& tables_for(std::span<const TablesFile> files, const policy::SearchedSound& sound, const std::string& asked_by) {
  const TablesFile* nearest = nullptr;
  for (const TablesFile& file : files) {
    if (policy::coverage(*file.tables, sound) != policy::Coverage::kCovered) continue;
    if (nearest == nullptr || distance(*file.tables, sound) < distance(*nearest->tables, sound)) nearest = &file;
  }
  if (nearest == nullptr) throw BadInput(asked_by + complaint(files, sound));
  return *nearest;
}

TablesFile tables_for(std::span<const fs::path> named, const policy::SearchedSound& sound, const std::string& asked_by) {
  std::vector<TablesFile> files = read_tables_files(named);
  const TablesFile& chosen = tables_for(files, sound, asked_by);
  return std::move(files[static_cast<std::size_t>(&chosen - files.data())]);
}

}  // namespace earshot::host
