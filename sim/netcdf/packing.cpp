#include "sim/netcdf/packing.hpp"

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "sim/netcdf/text_attribute.hpp"

namespace earshot::netcdf {
namespace {

constexpr std::size_t kAny = 0;  // of how many numbers an attribute has

bool is_floating(nc_type type) {
  return type == NC_FLOAT || type == NC_DOUBLE;
}

double modulus_of(nc_type type) {
  if (type == NC_BYTE || type == NC_UBYTE) return 256.0;
  if (type == NC_SHORT || type == NC_USHORT) return 65'536.0;
  return type == NC_INT || type == NC_UINT ? 4'294'967'296.0 : 0.0;
}

bool is_unsigned(nc_type type) {
  return type == NC_UBYTE || type == NC_USHORT || type == NC_UINT;
}

/// What the library writes where nobody has written, of a variable without _FillValue. A byte has none: each of its values may be meant.
std::optional<double> default_fill(nc_type type) {
  switch (type) {
    case NC_SHORT:
      return NC_FILL_SHORT;
    case NC_USHORT:
      return NC_FILL_USHORT;
    case NC_INT:
      return NC_FILL_INT;
    case NC_UINT:
      return NC_FILL_UINT;
    case NC_INT64:
      return static_cast<double>(NC_FILL_INT64);
    case NC_UINT64:
      return static_cast<double>(NC_FILL_UINT64);
    case NC_FLOAT:
      return static_cast<double>(NC_FILL_FLOAT);
    case NC_DOUBLE:
      return NC_FILL_DOUBLE;
    default:
      return std::nullopt;
  }
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace

Packing::Packing(int file, int variable) : file_(file), variable_(variable) {
  (void)nc_inq_vartype(file, variable, &type_);
  const std::string is_unsigned_text = lower_case(text_attribute(file, variable, "_Unsigned").value_or(""));
  meant_unsigned_ = is_unsigned_text == "true";
  if (is_unsigned_text == (is_unsigned(type_) ? "false" : "true")) sign_modulus_ = modulus_of(type_);
  if (has("_Unsigned") && is_unsigned_text != "true" && is_unsigned_text != "false") fault_ = "_Unsigned: must be true or false";
  if (const std::vector<double> scale = expect("scale_factor", 1, "one number"); !scale.empty()) scale_ = scale.front();
  if (const std::vector<double> offset = expect("add_offset", 1, "one number"); !offset.empty()) offset_ = offset.front();
  is_packed_ = scale_ != 1.0 || offset_ != 0.0;
  for (const char* attribute : {"_FillValue", "missing_value"}) {
    for (const double number : expect(attribute, kAny, "a number or several")) missing_.push_back(as_stored(number));
  }
  if (const std::optional<double> fill = default_fill(type_); fill && numbers("_FillValue").empty()) missing_.push_back(as_stored(*fill));
  limit("valid_range", true, true);
  limit("valid_min", true, false);
  limit("valid_max", false, true);
}

/// A number of an attribute as the variable's own type keeps it: 1e20 beside floats is 1.00000002e20.
double Packing::as_stored(double number) const {
  if (type_ == NC_FLOAT) return static_cast<double>(static_cast<float>(number));
  if (sign_modulus_ == 0.0) return number;
  if (meant_unsigned_) return number < 0.0 ? number + sign_modulus_ : number;
  return number >= 0.5 * sign_modulus_ ? number - sign_modulus_ : number;
}

bool Packing::has(const char* attribute) const {
  return nc_inq_att(file_, variable_, attribute, nullptr, nullptr) == NC_NOERR;
}

std::vector<double> Packing::expect(const char* attribute, std::size_t count, const char* what) {
  std::vector<double> found = numbers(attribute);
  const bool is_such = count == kAny ? !found.empty() : found.size() == count;
  if (is_such || !has(attribute)) return found;
  fault_ = std::string(attribute) + ": must be " + what;
  return {};
}

std::vector<double> Packing::numbers(const char* attribute) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file_, variable_, attribute, &type, &length) != NC_NOERR || type == NC_CHAR || type > NC_UINT64) return {};
  std::vector<double> values(length);
  if (nc_get_att_double(file_, variable_, attribute, values.data()) != NC_NOERR) values.clear();
  return values;
}

void Packing::limit(const char* attribute, bool below, bool above) {
  std::vector<double> ends = below && above ? expect(attribute, 2, "two numbers") : expect(attribute, 1, "one number");
  if (ends.empty()) return;
  nc_type type = NC_NAT;
  (void)nc_inq_atttype(file_, variable_, attribute, &type);
  const bool is_of_values = is_packed_ && is_floating(type) && !is_floating(type_);
  Limits& limits = is_of_values ? of_values_ : of_stored_;
  if (!is_of_values) std::ranges::transform(ends, ends.begin(), [this](double end) { return as_stored(end); });
  if (below) limits.lowest = std::max(limits.lowest, ends.front());
  if (above) limits.highest = std::min(limits.highest, ends.back());
}

double Packing::value_of(double stored) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double number = sign_modulus_ == 0.0 ? stored : as_stored(stored);
  if (std::ranges::find(missing_, number) != missing_.end() || !of_stored_.allow(number)) return kNone;
  const double value = number * scale_ + offset_;
  return of_values_.allow(value) ? value : kNone;
}

}  // namespace earshot::netcdf
