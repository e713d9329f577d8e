#include "policy/own_search/own_folder.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "firmware/host/mission/tables_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "policy/own_search/own_files.hpp"
#include "policy/own_search/own_policy.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::own_search {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPublicKeyFile = "search.pub";
constexpr std::array<std::string_view, 8> kFiles{kMissionFile, kOceanFile,  kRunFile, kReadmeFile,
                                                 kPolicyFile,  kTablesFile, kKeyFile, kPublicKeyFile};

[[noreturn]] void fail(const fs::path& folder, int error) {
  throw host::BadInput(folder.string() + ": cannot be made: " + std::generic_category().message(error));
}

/// What earshot fly or earshotd left there: a folder of theirs, or a journal with its policy and tables.
bool is_of_a_flight(const fs::directory_entry& entry) {
  const fs::path journal = "journal.lcmlog";
  const fs::path& path = entry.path();
  if (entry.is_symlink()) return false;
  if (entry.is_directory()) return !host::journals_beside(path / journal).empty() || fs::is_directory(path / "unfinished-flight");
  const bool is_kind = path.extension() == ".lcmlog" || path.extension() == ".policy" || path.extension() == ".tables";
  return entry.is_regular_file() && is_kind && host::name_of(journal, fs::path(path).replace_extension(journal.extension()));
}

std::vector<fs::path> flights_in(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (is_of_a_flight(entry)) names.push_back(entry.path().filename());
  return names;
}

/// Whether something stands in the folder's place that may go.
bool is_earlier(const fs::path& folder, Earlier earlier) {
  if (!fs::exists(folder)) return false;
  if (!fs::is_directory(folder)) throw host::BadInput(folder.string() + ": is no folder");
  if (fs::is_empty(folder)) return true;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (std::ranges::find(kFiles, name) != kFiles.end() && entry.is_regular_file()) continue;
    if (is_of_a_flight(entry)) continue;
    throw host::BadInput(folder.string() + ": holds " + host::printable(name) +
                         ", which is none of the files that earshot init makes, and no flight: name a new folder");
  }
  if (earlier == Earlier::kReplaced) return true;
  throw host::BadInput(folder.string() + ": is there already, with files in it: name a new folder, or --force replaces it");
}

/// A folder beside its place, which goes unless it is kept.
class FolderToBe {
 public:
  explicit FolderToBe(const fs::path& folder) {
    std::string name = (folder.parent_path() / ("." + folder.filename().string() + ".XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr) fail(folder, errno);
    path_ = name;
  }
  FolderToBe(const FolderToBe&) = delete;
  FolderToBe& operator=(const FolderToBe&) = delete;
  /// What stands there after keep() is the earlier one, if there was one, without its flights.
  ~FolderToBe() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  [[nodiscard]] const fs::path& path() const { return path_; }

  void keep(const fs::path& folder, bool has_earlier) {
    constexpr auto kAsAnyFolder = static_cast<fs::perms>(0755);
    fs::permissions(path_, kAsAnyFolder);
    const unsigned how = has_earlier ? RENAME_EXCHANGE : RENAME_NOREPLACE;
    const std::vector<fs::path> flights = has_earlier ? flights_in(folder) : std::vector<fs::path>{};
    if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, folder.c_str(), how) != 0) fail(folder, errno);
    std::error_code error;
    for (std::size_t i = 0; i < flights.size() && !error; ++i) fs::rename(path_ / flights[i], folder / flights[i], error);
    if (!error) return;
    undo(folder, flights);
    fail(folder, error.value());
  }

 private:
  /// The earlier folder stands in its place again, as it was; where that fails, nothing goes.
  void undo(const fs::path& folder, const std::vector<fs::path>& flights) {
    std::error_code error;
    for (const fs::path& name : flights)
      if (!error && fs::exists(folder / name)) fs::rename(folder / name, path_ / name, error);
    if (error || ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) != 0) path_.clear();
  }

  fs::path path_;
};

void write_files(const fs::path& here, const OwnSearch& search, FliesBy by, const fs::path& folder) {
  host::write_whole(here / kMissionFile, mission_text(search, by));
  host::write_whole(here / kOceanFile, ocean_text(search));
  host::write_whole(here / kReadmeFile, readme_text(search, by, folder));
  host::write_whole(here / kRunFile, run_text());
  fs::permissions(here / kRunFile, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add);
}

/// As the vehicle and the simulator would, but for tables that are yet to be made.
void judge(const fs::path& here, FliesBy by) {
  const fs::path mission = here / kMissionFile;
  const host::MissionFile file = host::load_mission(mission);
  host::require_ports_for_sea(file, mission);
  const host::SignedPolicy policy = host::load_policy(file.policy, file.public_key);
  host::require_repeats_golden(*policy.policy, file.policy);
  host::check_fits(*policy.policy, file.policy, file.mission, mission);
  (void)search::load_scenario(here / kOceanFile);
  if (by == FliesBy::kTablesToBeMade) return;
  host::require_named_files(file);
  const host::TablesFile tables = host::tables_of(file.tables, *policy.policy, file.mission, mission);
  (void)host::load_tables(tables.path, file.public_key);
}

void keep(std::initializer_list<std::string_view> names, const fs::path& earlier, const fs::path& here) {
  for (const std::string_view name : names)
    if (fs::exists(earlier / name)) fs::copy_file(earlier / name, here / name);
}

/// Tables of a folder's own may have taken hours: a search that cannot fly by them does not replace them.
void judge_kept_tables(const fs::path& folder, const fs::path& here) {
  if (!fs::exists(here / kTablesFile)) return;
  try {
    judge(here, FliesBy::kOwnPolicy);
  } catch (const host::BadInput& e) {
    throw host::BadInput(std::string(e.what()) + "; " + (folder / kTablesFile).string() +
                         " is of the earlier search, and --force keeps it: move it elsewhere first");
  }
}

void write(const fs::path& folder, const fs::path& here, const OwnSearch& search, FliesBy by) {
  if (by != FliesBy::kWhatShips) write_own_policy(here, search);
  write_files(here, search, by, folder);
}

/// `text` with every place in `here` as one in `there`; "": by its name alone.
std::string with_places(std::string text, const std::string& here, const std::string& there) {
  for (std::size_t at = text.find(here); at != std::string::npos; at = text.find(here, at + there.size()))
    text.replace(at, here.size(), there);
  return text;
}

}  // namespace

FliesBy make_own_folder(const fs::path& named, const OwnSearch& search, Earlier earlier) {
  fs::path folder = fs::weakly_canonical(fs::absolute(named));
  if (!folder.has_filename()) folder = folder.parent_path();
  if (host::printable(folder.string()) != folder.string())
    throw host::BadInput(host::printable(folder.string()) + ": has characters that steer a terminal: name another folder");
  require_consistent(search);
  const FliesBy by = flies_by(search);
  if (!fs::is_directory(folder.parent_path())) throw host::BadInput(folder.parent_path().string() + ": no such folder");
  const bool has_earlier = is_earlier(folder, earlier);
  FolderToBe to_be(folder);
  if (has_earlier) keep({kKeyFile, kPublicKeyFile}, folder, to_be.path());
  if (has_earlier && by != FliesBy::kOwnPolicy) keep({kTablesFile}, folder, to_be.path());
  try {
    write(folder, to_be.path(), search, by);
  } catch (const host::BadInput& e) {
    throw host::BadInput(with_places(e.what(), to_be.path().string(), folder.string()));
  }
  try {
    judge(to_be.path(), by);
    if (by == FliesBy::kTablesToBeMade) judge_kept_tables(folder, to_be.path());
  } catch (const host::BadInput& e) {  // of files that are gone again: nobody finds them by their paths
    throw host::BadInput("these options make a search that is refused: " + with_places(e.what(), to_be.path().string() + "/", ""));
  }
  to_be.keep(folder, has_earlier);
  return by;
}

}  // namespace earshot::own_search
