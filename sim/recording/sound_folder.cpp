#include "sim/recording/sound_folder.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::recording {
namespace {

bool is_hidden(const std::filesystem::path& path) {
  return path.filename().string().starts_with('.');
}

bool is_named_as_sound(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 8> kEndings{".wav", ".flac", ".aif", ".aiff", ".caf", ".w64", ".rf64", ".bwf"};
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::ranges::find(kEndings, ending) != kEndings.end();
}

/// What is_named_as_sound() in the folder, and folders within it that cannot be read. @return why the folder itself cannot be
std::error_code collect(const std::filesystem::path& folder, std::vector<std::filesystem::path>& found) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::filesystem::path& path = entry->path();
    std::error_code ignored;
    if (is_hidden(path)) continue;
    if (std::filesystem::is_directory(entry->symlink_status(ignored))) {
      if (collect(path, found)) found.push_back(path);
    } else if (is_named_as_sound(path) && !entry->is_directory(ignored)) {
      found.push_back(path);
    }
  }
  return error;
}

std::vector<std::filesystem::path> recordings_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  if (const std::error_code error = collect(folder, found)) throw host::BadInput(folder.string() + ": cannot be read: " + error.message());
  std::ranges::sort(found);
  return found;
}

}  // namespace

std::vector<std::filesystem::path> recordings_in(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::filesystem::path> all;
  for (const std::filesystem::path& path : paths) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(path, ignored)) {
      all.push_back(path);
      continue;
    }
    const std::vector<std::filesystem::path> found = recordings_of(path);
    if (found.empty()) throw host::BadInput(path.string() + ": is a folder without a recording");
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace earshot::recording
