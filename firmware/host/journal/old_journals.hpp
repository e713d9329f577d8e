#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace earshot::host {

/// The journals of earlier flights in a folder, which may be deleted to make room for the next: the oldest first, with all of its parts and
/// the policy and the tables beside it. Never touched is what is no regular file, does not begin as a journal (or a policy, or tables)
/// does, or is written by another process. A file is looked at again before it is deleted: what somebody took away counts no more, what he
/// put in its place stays. Nothing allocates after construction.
class OldJournals {
 public:
  OldJournals() = default;
  /// @param wanted  after which they are named   @param own  the number of the journal that is written now
  OldJournals(const std::filesystem::path& wanted, int own);

  /// Bytes of those that are there.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// @return whether bytes() is less now: one was, or somebody else had taken it away; false: none is left that may be
  bool delete_oldest();
  /// Journals, so far.
  [[nodiscard]] std::size_t deleted() const { return deleted_; }
  /// The number of the last of them; 0: none was.
  [[nodiscard]] int last_deleted() const { return last_deleted_; }

 private:
  struct File {
    std::filesystem::path path;
    std::uint64_t bytes = 0;  ///< that count; those of policy and tables do not
    std::string_view magic;   ///< as it begins
  };
  struct Old {
    int number = 0;
    std::vector<File> files{};  ///< the first part first, policy and tables last
  };
  [[nodiscard]] static bool is_written(const Old& old);
  /// @return whether bytes() is less now
  bool remove(const Old& old);

  std::vector<Old> journals_;  ///< the oldest first
  std::size_t next_ = 0;
  std::uint64_t bytes_ = 0;
  std::size_t deleted_ = 0;
  int last_deleted_ = 0;
};

/// Deletes all parts of a journal but the first, whatever may be missing between them; nothing but regular files that begin as a journal
/// does.
void delete_later_parts(const std::filesystem::path& first);
/// Deletes these parts of a journal, the last of them first; nothing but regular files that begin as a journal does, or with zeros, where a
/// power cut left a size and no content.
void delete_parts(std::span<const std::filesystem::path> parts);

}  // namespace earshot::host
