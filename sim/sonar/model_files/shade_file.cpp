#include "sim/sonar/model_files/shade_file.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string_view>
#include <vector>

namespace earshot::sonar::model_files {
namespace {

static_assert(std::endian::native == std::endian::little,
              "shade files have the byte order of the machine, which readers take for little endian");

/// A record of a Fortran file of direct access: as long as all others, zeros behind what it holds.
class Record {
 public:
  explicit Record(std::size_t words) { bytes_.reserve(4 * words); }

  template <class Number>
  Record& add(Number number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof(number));
    return *this;
  }
  Record& add_text(std::string text, std::size_t length) {
    text.resize(length, ' ');
    bytes_ += text;
    return *this;
  }
  [[nodiscard]] std::string padded(std::size_t words) const {
    std::string record = bytes_;
    record.resize(4 * words, '\0');
    return record;
  }

 private:
  std::string bytes_;
};

/// A number in the precision of the layout.
void add_number(Record& record, ShadeLayout layout, double number) {
  if (layout == ShadeLayout::kDouble)
    record.add(number);
  else
    record.add(static_cast<float>(number));
}

std::int32_t size_of(const std::vector<double>& values) {
  return static_cast<std::int32_t>(values.size());
}

std::string header(const SonarField& field, const ShadeSource& source, ShadeLayout layout, std::size_t words) {
  constexpr std::size_t kTitleLength = 80;
  constexpr std::size_t kTypeLength = 10;
  std::vector<Record> records(10, Record(words));
  records[0].add(static_cast<std::int32_t>(words)).add_text(std::string(kShadeOutput.mark) + source.title, kTitleLength);
  records[1].add_text("rectilin", kTypeLength);
  for (const int one : {1, 1, 1, 1, 1}) records[2].add(static_cast<std::int32_t>(one));  // frequencies, bearings, sources in x, y and z
  records[2].add(size_of(field.depth_m)).add(size_of(field.range_m));
  add_number(records[2], layout, source.frequency.value);
  add_number(records[2], layout, 0.0);  // the attenuation that SCOOTER adds
  records[3].add(source.frequency.value);
  for (std::size_t i = 4; i < 7; ++i) add_number(records[i], layout, 0.0);  // bearing, x and y
  records[7].add(static_cast<float>(source.depth.value));
  for (const double depth_m : field.depth_m) records[8].add(static_cast<float>(depth_m));
  for (const double range_m : field.range_m) add_number(records[9], layout, range_m);
  std::string text;
  for (const Record& record : records) text += record.padded(words);
  return text;
}

}  // namespace

void write_shade(const std::filesystem::path& path, const SonarField& field, const ShadeSource& source, ShadeLayout layout) {
  assert(field.pressure.size() == field.range_m.size() * field.depth_m.size());
  constexpr std::size_t kLeastWords = 41;  // of the record that holds the title
  const std::size_t words = std::max({kLeastWords, field.depth_m.size(), 2 * field.range_m.size()});
  host::OutputFile file(path);
  file.write(header(field, source, layout, words));
  std::vector<std::complex<double>> carrier;
  const double k0_per_m = field.grid ? field.grid->reference_wavenumber_per_m : 0.0;  // without a march there is no number to turn
  for (const double range_m : field.range_m) carrier.push_back(std::polar(1.0, k0_per_m * range_m));
  for (std::size_t depth = 0; depth < field.depth_m.size(); ++depth) {
    Record record(words);
    for (std::size_t range = 0; range < field.range_m.size(); ++range) {
      const std::complex<double> pressure = -std::conj(field.pressure[range * field.depth_m.size() + depth] * carrier[range]);
      record.add(static_cast<float>(pressure.real())).add(static_cast<float>(pressure.imag()));
    }
    file.write(record.padded(words));
  }
  file.commit();
}

}  // namespace earshot::sonar::model_files
