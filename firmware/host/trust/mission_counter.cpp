#include "firmware/host/trust/mission_counter.hpp"

#include <string>
#include <system_error>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/trust/line_reader.hpp"

namespace earshot::host {
namespace {

constexpr FileKind kCounterFile{"a mission counter", 1024};
constexpr OutputKind kCounterOutput{"a mission counter", {"Earshot mission counter ", {}}};
constexpr const char* kTitle = "Earshot mission counter 1";
constexpr const char* kChecksum = "crc32 ";

std::string text_of(const authority::MissionManifest& manifest) {
  const std::string written = std::string(kTitle) + "\n" + lines_of(manifest);
  return written + kChecksum + crc32_text(crc32_of(written)) + "\n";
}

FileDescriptor locked_folder_of(const std::filesystem::path& counter_file) {
  try {
    return lock_folder(followed(counter_file).parent_path());
  } catch (const std::system_error& e) {
    throw BadInput(counter_file.string() + ": its folder cannot be locked: " + e.what());
  }
}

}  // namespace

authority::MissionManifest read_flown_last(const std::filesystem::path& counter_file) {
  try {
    const std::string text = read_text(counter_file, kCounterFile);
    LineReader reader(text, counter_file);
    reader.title(kTitle);
    const authority::MissionManifest manifest = reader.manifest();
    // What stands behind is not read but compared: there is one text for each manifest.
    if (text != text_of(manifest)) throw BadInput(counter_file.string() + ": is damaged: its CRC-32 is wrong");
    return manifest;
  } catch (const BadInput& e) {
    throw BadInput(std::string(e.what()) + "; without the counter of the mission flown last none is flown. " +
                   "earshot verify --new-counter N makes such a file where none is");
  }
}

void begin_counter(const std::filesystem::path& counter_file, std::uint64_t counter) {
  std::error_code error;
  if (std::filesystem::symlink_status(counter_file, error).type() != std::filesystem::file_type::not_found)
    throw BadInput(counter_file.string() +
                   ": is there already, and never replaced: it knows what the vehicle flew; move a damaged one away");
  write_new(counter_file, text_of({.counter = counter, .mission = {}, .policy = {}}), Access::kOwnerWrites);
}

void raise_counter(const std::filesystem::path& counter_file, std::uint64_t counter) {
  MissionCounter held(counter_file);
  if (counter <= held.flown_last().counter)
    throw BadInput(counter_file.string() + ": stands at " + std::to_string(held.flown_last().counter) + ", and is raised only");
  held.record({.counter = counter, .mission = {}, .policy = {}});
}

void require_recordable(const std::filesystem::path& counter_file) {
  require_writable(counter_file, kCounterOutput, Replace::kOwnKind, "it stays");
}

MissionCounter::MissionCounter(std::filesystem::path counter_file) : file_(std::move(counter_file)) {
  (void)read_flown_last(file_);  // says more of a file that is not there than its lock
  lock_ = locked_folder_of(file_);
  flown_last_ = read_flown_last(file_);
  require_recordable(file_);
}

void MissionCounter::record(const authority::MissionManifest& manifest) {
  if (manifest == flown_last_) return;
  write_whole(file_, text_of(manifest));
  flown_last_ = manifest;
}

}  // namespace earshot::host
