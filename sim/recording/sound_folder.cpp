#include "sim/recording/sound_folder.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

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

std::vector<std::filesystem::path> recordings_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::recursive_directory_iterator(); entry.increment(error)) {
    if (is_hidden(entry->path()))
      entry.disable_recursion_pending();
    else if (is_named_as_sound(entry->path()) && !entry->is_directory())
      found.push_back(entry->path());
  }
  if (error) throw host::BadInput(folder.string() + ": cannot be read: " + error.message());
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
