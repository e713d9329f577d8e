#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/journal/journal_name.hpp"

namespace earshot::host {

/// The parts of a journal, read as if they were one file. A later part begins with a record that names its number and the checksum of the
/// journal's first record (journal_part_t); one that names another belongs to an earlier journal of that name, and is passed over. A part
/// whose beginning is damaged is taken for one of the journal's. Where a part is missing it is read on at the next: the numbers of the
/// records tell.
class JournalParts {
 public:
  /// @throws host::BadInput naming the first file if it cannot be read, is no regular file, or is a later part of a journal beside it.
  explicit JournalParts(const std::filesystem::path& first);

  /// Fills `into`; less is read only at the end of the last part. Parts that have come since are read, too. @throws host::BadInput
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into);
  /// The next read() begins so many bytes behind the beginning of the first. @throws host::BadInput
  void go_to(std::uint64_t offset);

  /// Bytes of all parts, when they were first seen.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Where a byte of all lies.
  struct Place {
    int part = 1;
    std::filesystem::path file;
    std::uint64_t offset = 0;  ///< from its beginning
  };
  /// Between two parts: behind the first of them.
  [[nodiscard]] Place place_of(std::uint64_t offset) const;
  [[nodiscard]] bool are_several() const { return parts_.size() > 1; }
  /// How many parts are missing right before the one where a byte of all lies.
  [[nodiscard]] int missing_before(std::uint64_t offset) const;
  /// A part of this journal that bears another part's name, and is not read. Nothing: there is none.
  [[nodiscard]] std::optional<std::filesystem::path> misplaced() const;
  /// Of the parts that are known, the first before the others.
  [[nodiscard]] std::vector<std::filesystem::path> files() const;

 private:
  struct Part {
    int number = 1;
    std::uint64_t begin = 0;  ///< bytes from the beginning of the first
  };
  struct Opened {
    int number = 1;
    InputFile file;
  };
  [[nodiscard]] std::filesystem::path path_of(std::size_t index) const { return part_of(first_, parts_[index].number); }
  /// The part behind the last that is known, if there is one.
  [[nodiscard]] std::optional<Opened> next_part() const;
  [[nodiscard]] std::optional<InputFile> open(int number) const;
  void refuse_part_of(const std::filesystem::path& journal) const;
  [[nodiscard]] bool belongs(InputFile& file, int number) const;
  [[nodiscard]] std::size_t index_of(std::uint64_t offset) const;

  std::filesystem::path first_;
  std::optional<std::uint32_t> id_;  ///< checksum of the journal's first record; nothing: that is damaged
  std::vector<Part> parts_{{}};      ///< that are known
  std::size_t current_ = 0;          ///< the one that is read
  InputFile file_;
  std::uint64_t position_ = 0;  ///< in it
  std::uint64_t size_ = 0;
};

}  // namespace earshot::host
