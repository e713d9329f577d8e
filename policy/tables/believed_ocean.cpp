#include "policy/tables/believed_ocean.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::tables {
namespace {

namespace fs = std::filesystem;

constexpr double kSameFrequency_hz = 1e-6;  // rounding

std::vector<fs::path> toml_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty()) throw host::BadInput(folder.string() + ": holds no environment file (.toml)");
  std::ranges::sort(files);
  return files;
}

std::string described(const BelievedOcean& ocean) {
  std::ostringstream text;
  text << "source.frequency_hz = " << ocean.environment.source.frequency.value << " in " << ocean.file.string();
  return text.str();
}

}  // namespace

std::vector<fs::path> environment_files(const std::vector<std::string>& named) {
  std::vector<fs::path> files;
  for (const std::string& name : named) {
    if (!fs::is_directory(name)) {
      files.emplace_back(name);
      continue;
    }
    for (fs::path& file : toml_files_in(name)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<BelievedOcean> oceans_in(const fs::path& file) {
  search::Scenario scenario = search::load_scenario(file);
  const std::string name = scenario.environment.name;
  std::vector<BelievedOcean> oceans{
      {.file = file, .environment = std::move(scenario.environment), .detail = "", .field_library = std::move(scenario.field_library)}};
  for (ocean::Environment& other : scenario.other_oceans) {
    std::string detail = other.name == name ? " " + std::to_string(oceans.size()) : "";
    oceans.push_back({.file = file, .environment = std::move(other), .detail = std::move(detail)});
  }
  return oceans;
}

void require_one_frequency(const std::vector<BelievedOcean>& oceans) {
  for (const BelievedOcean& ocean : oceans) {
    const double apart = (ocean.environment.source.frequency - oceans.front().environment.source.frequency).value;
    if (!(std::abs(apart) <= kSameFrequency_hz))
      throw host::BadInput(described(ocean) + ": must be one frequency in all environments, and is " + described(oceans.front()));
  }
}

}  // namespace earshot::tables
