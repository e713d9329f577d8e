#include "sim/search/scenario/file_kind.hpp"

#include <string_view>

namespace earshot::search {
namespace {

std::string_view to_string(FileKind kind) {
  switch (kind) {
    case FileKind::kOther:
      return "another file";
    case FileKind::kEnvironment:
      return "an environment (an ocean, for --environment)";
    case FileKind::kWorld:
      return "a world (an environment and conditions to search in, for --world)";
    case FileKind::kMission:
      return "a mission (for --mission)";
  }
  return "";
}

}  // namespace

FileKind kind_of(const host::TomlFile& file) {
  const host::TableReader root = file.root();
  if (root.has("search") && root.has("area")) return FileKind::kMission;
  if (root.has("environment") && root.has("name") && root.has("what")) return FileKind::kWorld;
  return root.has("source") && root.has("seabed") ? FileKind::kEnvironment : FileKind::kOther;
}

FileKind kind_of(const std::filesystem::path& path) try { return kind_of(host::TomlFile(path)); } catch (const host::BadInput&) {
  return FileKind::kOther;
}

void require_kind(const std::string& option, const host::TomlFile& file, FileKind wanted) {
  const FileKind kind = kind_of(file);
  if (kind == wanted || kind == FileKind::kOther) return;
  throw host::BadInput(option + (option.empty() ? "" : " ") + file.path().string() + ": is " + std::string(to_string(kind)) + ", not " +
                       std::string(to_string(wanted)));
}

}  // namespace earshot::search
