#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/host/file/output_file.hpp"

namespace earshot::annotation {

/// One box in time and frequency.
struct Selection {
  double begin_s = 0.0;  ///< from the start of the file sequence
  double end_s = 0.0;
  double low_hz = 0.0;
  double high_hz = 0.0;
  int channel = 1;                  ///< from 1
  std::string begin_file;           ///< name without folder; empty: not told
  double file_offset_s = 0.0;       ///< of the begin, in that file
  std::vector<std::string> values;  ///< of the further columns
  bool names_channel = false;       ///< read: the table has it
  bool names_offset = false;        ///< read: the table has the offset
};

/// A selection table as Raven (Cornell Lab of Ornithology) reads and writes it: tab-separated, one line a selection.
struct SelectionTable {
  std::vector<std::string> columns;  ///< further ones, in the order of Selection::values; only written
  std::vector<Selection> selections;
};

/// Which files a table may replace: others of its kind.
inline constexpr host::OutputKind kSelectionOutput{"a Raven selection table", {"Selection\tView\tChannel\t", {}}};

/// The times with microseconds, so that a sample is met.
/// Source: Raven Pro 1.6 User's Manual, "Selection tables" and "Saving and retrieving selection tables".
/// Oracle: SelectionTable.*
[[nodiscard]] std::string to_text(const SelectionTable& table);

/// Reads "Begin Time (s)" and "End Time (s)" wherever they stand, the other columns where they are there, and nothing else. Raven gives a
/// selection one line for each view: lines of the same number, times, file and channel are one selection. Lines end with CR, LF or both.
///
/// Also Audacity's labels (begin, end and label, without a first line of names; a line "\, low, high" behind gives the frequencies), and
/// tables parted by comma or semicolon whose columns are called start, end or duration, file, channel and the like, all in seconds and
/// hertz. Source: Audacity Manual, "Importing and Exporting Labels"; RFC 4180.
///
/// Throws host::BadInput with all that is wrong (the first twenty), "FILE:LINE: COLUMN = VALUE: reason".
[[nodiscard]] SelectionTable read_selection_table(const std::filesystem::path& path);

/// The same of a text. @param name  what messages call it
[[nodiscard]] SelectionTable selection_table_from(std::string_view text, const std::string& name);

}  // namespace earshot::annotation
