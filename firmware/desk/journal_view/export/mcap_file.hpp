#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/desk/journal_view/export/mcap_bytes.hpp"
#include "firmware/desk/journal_view/export/zstd_frames.hpp"

namespace earshot::journal {

inline constexpr host::OutputKind kMcapOutput{"an MCAP file", {"\x89MCAP0\r\n", {}}};

/// Writes an MCAP file of JSON messages: chunks that are compressed with zstd, each with its index and its checksum, so that readers find a
/// moment without reading the whole; files that are attached; a summary with statistics; checksums of the data and of the summary. Memory:
/// a chunk (1 MiB), twice, what its compression takes, and 100 bytes for each chunk written.
/// Source: MCAP Format Specification (https://mcap.dev/spec).   Oracle: journal.mcap_is_read_by_mcap (PyPI's mcap)
class McapFile {
 public:
  using Channel = std::uint16_t;

  struct Schema {
    std::string_view name;
    std::string_view json;
  };
  struct Message {
    Channel channel = 0;
    std::uint32_t sequence = 0;
    Time logged;     ///< before 1970 or after 2262, which the format cannot say: the nearest it can
    Time published;  ///< likewise
    std::string_view json;
  };

  struct Attachment {
    Time time;  ///< when it was logged, and when it was made
    std::string_view name;
    std::string_view media_type;
    std::string_view content;
  };

  /// @param library  what wrote it. @throws host::BadInput naming the file.
  McapFile(const std::filesystem::path& path, std::string_view library);

  /// At most 65535.
  [[nodiscard]] Channel add_channel(std::string_view topic, const Schema& schema);
  void write(const Message& message);
  void attach(const Attachment& attachment);
  /// Gives the file its name. @throws host::BadInput naming the file.
  void finish();
  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  struct Span {
    std::uint64_t first = std::numeric_limits<std::uint64_t>::max();  ///< ns
    std::uint64_t last = 0;
    void note(std::uint64_t time_ns);
    [[nodiscard]] std::uint64_t begin() const { return first <= last ? first : 0; }
  };
  using Index = std::map<Channel, std::vector<std::pair<std::uint64_t, std::uint64_t>>>;  ///< time in ns, offset in the chunk

  void put(std::string_view bytes);
  void end_chunk();
  void end_summary(std::uint64_t summary_start);
  [[nodiscard]] McapBytes statistics() const;

  PiecewiseFile file_;
  std::uint64_t offset_ = 0;  ///< bytes in the file so far
  std::uint32_t crc_ = 0;     ///< of the section so far
  McapBytes chunk_;           ///< its records
  ZstdFrames frames_;
  Span chunk_span_;
  Index index_;  ///< of the chunk
  Span span_;
  std::uint64_t messages_ = 0;
  std::map<Channel, std::uint64_t> messages_on_;
  Channel last_channel_ = 0;  ///< each has a schema of the same number
  std::uint32_t chunks_ = 0;
  McapBytes schemas_;  ///< records for the summary
  McapBytes channels_;
  McapBytes chunk_indexes_;
  McapBytes attachment_indexes_;
  std::uint32_t attachments_ = 0;
};

}  // namespace earshot::journal
