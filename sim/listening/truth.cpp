#include "sim/listening/truth.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::listening {
namespace {

using annotation::Selection;

/// Tables round times; the last call may end with the sound.
constexpr double kRounding_s = 0.1;

/// Without folder and ending: a table may name the WAV file of what is a FLAC file now, or have other folders.
std::string stem_of(std::string_view path) {
  const std::size_t folder = path.find_last_of("/\\");
  std::string name(folder == std::string_view::npos ? path : path.substr(folder + 1));
  const std::size_t ending = name.rfind('.');
  return ending == std::string::npos || ending == 0 ? name : name.substr(0, ending);
}

/// A file of the sequence, in seconds from the start of the sequence.
struct File {
  std::string stem;
  double begin_s = 0.0;
  double duration_s = 0.0;
  double first_s = 0.0;  ///< of the file, at the begin
};

bool is_of(const Selection& selection, const File& file) {
  return file.stem == stem_of(selection.begin_file);
}

std::vector<File> files_of(const recording::Sequence& sequence) {
  std::vector<File> files;
  const double rate = sequence.sample_rate().value;
  for (const recording::Part& part : sequence.parts())
    files.push_back({.stem = stem_of(part.path.string()),
                     .begin_s = static_cast<double>(part.begin) / rate,
                     .duration_s = static_cast<double>(part.frames) / rate,
                     .first_s = static_cast<double>(part.first_frame) / rate});
  return files;
}

class Placing {
 public:
  Placing(const std::string& name, const recording::Sequence& sequence)
      : name_(name), files_(files_of(sequence)), end_s_(sequence.duration().to_seconds()) {
    for (const recording::Part& part : sequence.parts())
      for (const recording::Part& other : sequence.parts())
        if (other.path != part.path && stem_of(other.path.string()) == stem_of(part.path.string())) has_namesakes_ = true;
  }

  [[nodiscard]] bool is_of_these_files(const Selection& selection) const {
    return selection.begin_file.empty() || std::ranges::any_of(files_, [&](const File& file) { return is_of(selection, file); });
  }

  /// Begins from the start of the sequence.
  [[nodiscard]] std::vector<double> begins_of(const std::vector<Selection>& selections, bool is_of_more_files) const {
    const bool names_files = std::ranges::any_of(selections, [](const Selection& s) { return !s.begin_file.empty(); });
    if (names_files && has_namesakes_) throw host::BadInput(name_ + ": names files, and two of the recordings have the same name");
    const std::vector<double> in_sequence = begins(selections, [](const Selection& s) { return s.begin_s; });
    const std::vector<double> in_files = begins(selections, [this](const Selection& s) { return in_file(s, s.begin_s); });
    const std::vector<double> by_offset =
        begins(selections, [this](const Selection& s) { return s.names_offset ? in_file(s, s.file_offset_s) : std::nan(""); });
    if (names_files && are_placed(by_offset)) return by_offset;
    const bool fits_files = names_files && are_placed(in_files);
    const bool fits_sequence = !is_of_more_files && is_in_named_files(selections);
    if (fits_files && fits_sequence && in_files != in_sequence)
      throw host::BadInput(
          name_ + ": its times may count from the start of each file or from that of the first: a column \"File Offset (s)\" decides");
    if (fits_files) return in_files;
    if (fits_sequence) return in_sequence;
    refuse(selections, names_files);
  }

 private:
  template <typename Begin>
  static std::vector<double> begins(const std::vector<Selection>& selections, Begin begin) {
    std::vector<double> all;
    for (const Selection& selection : selections) all.push_back(begin(selection));
    return all;
  }

  static bool are_placed(const std::vector<double>& begins_s) {
    return std::ranges::none_of(begins_s, [](double begin_s) { return std::isnan(begin_s); });
  }

  /// From the start of the sequence, of a time in a selection's file; NaN where the file has no such time.
  [[nodiscard]] double in_file(const Selection& selection, double time_s) const {
    for (const File& file : files_) {
      const bool is_there = time_s >= file.first_s - kRounding_s && time_s <= file.first_s + file.duration_s + kRounding_s;
      if (is_of(selection, file) && is_there) return file.begin_s + std::max(time_s - file.first_s, 0.0);
    }
    return std::nan("");
  }

  /// Whether each lies in the file that it names, as times of the sequence.
  [[nodiscard]] bool is_in_named_files(const std::vector<Selection>& selections) const {
    return std::ranges::all_of(selections, [this](const Selection& s) {
      if (s.begin_file.empty()) return s.begin_s <= end_s_;
      return std::ranges::any_of(files_, [&s](const File& file) {
        return is_of(s, file) && s.begin_s >= file.begin_s - kRounding_s && s.begin_s <= file.begin_s + file.duration_s + kRounding_s;
      });
    });
  }

  [[noreturn]] void refuse(const std::vector<Selection>& selections, bool names_files) const {
    const auto last = std::ranges::max_element(selections, {}, &Selection::begin_s);
    std::ostringstream text;
    text << name_ << ": a selection begins at " << last->begin_s << " s, the recording ends at " << end_s_ << " s: is it of other files?";
    if (names_files)
      text.str(name_ + ": its times fit neither the files that it names nor the recording as a whole: is it of other files?");
    throw host::BadInput(text.str());
  }

  std::string name_;
  std::vector<File> files_;
  double end_s_;
  bool has_namesakes_ = false;
};

}  // namespace

Truth truth_of(const annotation::SelectionTable& table, const std::string& name, const Listened& listened) {
  const Placing placing(name, listened.sequence);
  std::vector<Selection> here;
  std::ranges::copy_if(table.selections, std::back_inserter(here), [&placing](const Selection& s) { return placing.is_of_these_files(s); });
  if (here.empty() && !table.selections.empty())
    throw host::BadInput(name + ": none of its selections is of these files; the first is of " + table.selections.front().begin_file);
  Truth truth;
  const auto remark = [&](std::size_t count, const std::string& why) {
    if (count > 0) truth.remarks.push_back(name + ": " + std::to_string(count) + " of its selections are not counted: they are " + why);
  };
  const std::size_t elsewhere = table.selections.size() - here.size();
  remark(elsewhere, "of files that are not listened to");
  const std::vector<double> begins_s = placing.begins_of(here, elsewhere > 0);
  std::size_t of_other_channels = 0;
  std::size_t outside_of_band = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const Selection& s = here[i];
    const bool is_of_channel = !s.names_channel || static_cast<std::size_t>(s.channel) == listened.channel;
    const bool is_in_band = s.high_hz <= 0.0 || (s.high_hz >= listened.band.low.value && s.low_hz <= listened.band.high.value);
    if (!is_of_channel)
      ++of_other_channels;
    else if (!is_in_band)
      ++outside_of_band;
    else
      truth.intervals.push_back({begins_s[i], begins_s[i] + s.end_s - s.begin_s});
  }
  if (truth.intervals.empty() && !here.empty())
    throw host::BadInput(name + ": no score: none of its selections is of what is listened to: " + std::to_string(of_other_channels) +
                         " are of other channels than " + std::to_string(listened.channel) + ", " + std::to_string(outside_of_band) +
                         " of frequencies outside of the band");
  remark(of_other_channels, "of other channels than " + std::to_string(listened.channel));
  remark(outside_of_band, "of frequencies outside of the band that is listened to");
  return truth;
}

}  // namespace earshot::listening
