#include "policy/report/sound/heard_sound.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::report {
namespace {

using host::BadInput;

constexpr std::size_t kMostColumns = 1000;  ///< of a spectrogram: a hertz each

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t line) {
  throw BadInput(path.string() + ":" + std::to_string(line) + ": not a row of this table");
}

/// Lines with their numbers, from 1.
template <class Take>
void for_each_line(const std::filesystem::path& path, Take take) {
  std::istringstream stream(host::read_text(path, host::kCsvFile));
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) take(line, number);
}

std::vector<HeardRow> read_measurements(const std::filesystem::path& path) {
  std::vector<HeardRow> rows;
  for_each_line(path, [&](const std::string& line, std::size_t number) {
    if (number == 1) return;
    HeardRow row;
    int too_faint = 0;
    int modelled_too_faint = 0;
    const int read =
        std::sscanf(line.c_str(), "%lf,%lf,%d,%lf,%d", &row.time_s, &row.snr_db, &too_faint, &row.modelled_snr_db, &modelled_too_faint);
    if (read != 5 || !std::isfinite(row.time_s + row.snr_db + row.modelled_snr_db)) refuse(path, number);
    row.too_faint = too_faint != 0;
    row.modelled_too_faint = modelled_too_faint != 0;
    rows.push_back(row);
  });
  return rows;
}

/// The numbers after the first comma; nothing but numbers may stand there.
std::vector<double> numbers_in(const std::string& line, std::size_t from, bool& is_good) {
  std::vector<double> numbers;
  const char* at = line.c_str() + from;
  while (*at != '\0' && numbers.size() <= kMostColumns) {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    is_good = is_good && end != at && std::isfinite(numbers.back()) && (*end == ',' || *end == '\0');
    if (!is_good) return {};
    at = *end == ',' ? end + 1 : end;
  }
  return numbers;
}

SpectrogramTable read_spectrogram(const std::filesystem::path& path) {
  SpectrogramTable table;
  for_each_line(path, [&](const std::string& line, std::size_t number) {
    bool is_good = true;
    if (number == 1) {
      const std::size_t comma = line.find(',');
      if (comma == std::string::npos) refuse(path, number);
      table.frequency_hz = numbers_in(line, comma + 1, is_good);
      if (!is_good || table.frequency_hz.size() < 2 || table.frequency_hz.size() > kMostColumns) refuse(path, number);
      return;
    }
    const std::vector<double> row = numbers_in(line, 0, is_good);
    if (!is_good || row.size() != table.frequency_hz.size() + 1) refuse(path, number);
    table.time_s.push_back(row.front());
    table.level_db.insert(table.level_db.end(), row.begin() + 1, row.end());
  });
  return table;
}

}  // namespace

HeardSound read_heard_sound(const std::filesystem::path& folder) {
  return {.measurements = read_measurements(folder / kHearingName), .spectrogram = read_spectrogram(folder / kSpectrogramName)};
}

}  // namespace earshot::report
