#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// A kind of file that a program writes; it is recognised by its first bytes and, where others write files that begin so too, by a mark;
/// by the mark alone where no beginning is stated.
struct OutputKind {
  std::string_view name;  ///< with its article: "a NetCDF file of Earshot"
  std::array<std::string_view, 2> beginnings;
  std::string_view mark = {};   ///< what stands somewhere in each file that Earshot wrote, at most 64 bytes; empty: the first bytes tell
  bool is_recognisable = true;  ///< false where such files of others are the same: none is replaced unasked
};

/// The mark is how the attribute `source` begins: a chart that somebody downloaded has none.
inline constexpr OutputKind kNetcdfOutput{"a NetCDF file of Earshot", {"\x89HDF\r\n\x1a\n", "CDF"}, "Earshot, "};
inline constexpr OutputKind kPngOutput{"a PNG picture", {"\x89PNG\r\n\x1a\n", {}}};
inline constexpr OutputKind kSvgOutput{"an SVG picture", {"<?xml", "<svg"}};
inline constexpr OutputKind kHtmlOutput{"an HTML page", {"<!DOCTYPE html>", {}}};

/// The kind that the end of the name asks for: .png is a PNG picture, anything else an SVG one.
[[nodiscard]] OutputKind picture_kind(const std::filesystem::path& path);

/// Which files may be replaced.
enum class Replace : std::uint8_t {
  kOwnKind,  ///< empty ones, and such as are of the kind that is written
  kAny,      ///< any regular file: --force
};

/// Which files --force, or its absence, lets a program replace.
[[nodiscard]] constexpr Replace replaced_by(bool force) {
  return force ? Replace::kAny : Replace::kOwnKind;
}

/// What others may do with a file that is made anew, as far as the umask lets them.
enum class Access : std::uint8_t {
  kEveryone,     ///< read and write it
  kOwnerWrites,  ///< read it: what a vehicle trusts
  kOwnerOnly,    ///< nothing
};

/// The file that a path stands for: where its symbolic links end, whether anything is there yet or not.
/// Throws BadInput when they go round in a circle.
[[nodiscard]] std::filesystem::path followed(const std::filesystem::path& path);

/// Judges before the work what would be refused after it.
/// Throws BadInput naming the file when it is not a regular one, is of another kind than is to be written, or cannot be made in its folder.
/// @param instead  what a person can do about a file of another kind, or what is done
/// Oracle: OutputFile.*
void require_writable(const std::filesystem::path& path, const OutputKind& kind, Replace replace,
                      std::string_view instead = "--force replaces it");

/// The name of a file that is not whole yet: while this lives, a signal that ends the program takes the file with it
/// (remove_unfinished_on_signals()).
class UnfinishedName {
 public:
  explicit UnfinishedName(const std::filesystem::path& path);
  ~UnfinishedName();
  UnfinishedName(const UnfinishedName&) = delete;
  UnfinishedName& operator=(const UnfinishedName&) = delete;

 private:
  std::string name_;
  std::atomic<const char*>* slot_ = nullptr;  ///< where a signal handler finds it; null: all are taken, and a signal leaves it
};

/// From now on SIGHUP, SIGINT, SIGQUIT and SIGTERM, each where it would have ended this program, remove what has an UnfinishedName, and end
/// the program as before. Processes that it forks remove nothing.
void remove_unfinished_on_signals();

/// A file that is either whole or what it was before. It is written beside its place, brought to the disk and renamed; until then it has no
/// name, where the file system can do that, so that a program that is killed leaves nothing of it; where it has one, only a kill or a power
/// cut leaves it, and no signal that a program can handle. A symbolic link stays and what it points
/// to is replaced; a pipe, a device, a socket or a folder is refused and stays.
class OutputFile {
 public:
  /// Throws BadInput naming the file.
  explicit OutputFile(const std::filesystem::path& path, Access access = Access::kEveryone);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Unless commit() was called, nothing of it is left.
  ~OutputFile();

  /// Where it stands until commit(), for a library that opens files by name: from here on it has one. Throws BadInput naming the file.
  [[nodiscard]] const std::filesystem::path& partial();
  /// Throws BadInput naming the file, such as on a full disk.
  void write(std::string_view content);

  enum class Survives : std::uint8_t { kProcess, kPowerCut };
  /// Gives it its name. Throws BadInput naming the file; the older one is then still there.
  void commit(Survives survives = Survives::kPowerCut);
  /// Gives it its name for good, where nothing has that yet: of two programs one does. Throws BadInput naming the file.
  void commit_as_new();

 private:
  /// One may be left by a killed process of the same number.
  void make_room_for_partial() const;
  [[nodiscard]] bool open_without_name(mode_t mode);
  void open_partial(mode_t mode);
  void bring_content_to_disk() const;

  std::filesystem::path path_;          ///< as a person named it
  std::filesystem::path target_;        ///< where its links end
  std::filesystem::path partial_;       ///< what it is called, or would be, until it is whole
  std::optional<UnfinishedName> name_;  ///< that it has by now
  FileDescriptor file_;
};

/// Writes a whole file. Throws BadInput naming the file; the older one is then still there.
void write_whole(const std::filesystem::path& path, std::string_view content, Access access = Access::kEveryone);

/// Writes a whole file where none is. Throws BadInput naming the file, which then is whole and another's, or is not there.
void write_new(const std::filesystem::path& path, std::string_view content, Access access = Access::kEveryone);

}  // namespace earshot::host
