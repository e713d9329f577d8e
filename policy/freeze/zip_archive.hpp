#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct zip;

namespace earshot::freeze {

/// A zip archive in memory. What it throws is host::BadInput.
class ZipArchive {
 public:
  /// @param bytes  outlives this. Throws when they are no archive, are cut short, or name one entry twice.
  explicit ZipArchive(std::string_view bytes);

  [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }
  [[nodiscard]] std::vector<std::string> names() const;
  /// The whole entry, unpacked. Throws when there is none, it is over kMaxEntryBytes, or its bytes do not match their checksum.
  [[nodiscard]] std::string read(const std::string& name) const;
  /// The one entry whose name ends in `ending`. Throws unless there is exactly one.
  [[nodiscard]] std::string name_ending_in(std::string_view ending) const;

  static constexpr std::size_t kMaxEntryBytes = std::size_t{16} * 1024 * 1024;  ///< a small archive may unpack to any size

 private:
  std::unique_ptr<struct zip, void (*)(struct zip*)> archive_;
  std::map<std::string, std::uint64_t> entries_;  // name -> index
};

}  // namespace earshot::freeze
