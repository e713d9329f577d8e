#include "sim/netcdf/packing.hpp"

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "sim/netcdf/text_attribute.hpp"

namespace earshot::netcdf {
namespace {

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

}  // namespace

Packing::Packing(int file, int variable) : file_(file), variable_(variable) {
  (void)nc_inq_vartype(file, variable, &type_);
  const std::string said = text_attribute(file, variable, "_Unsigned").value_or("");
  meant_unsigned_ = said == "true";
  if (said == (is_unsigned(type_) ? "false" : "true")) sign_modulus_ = modulus_of(type_);
  if (const std::vector<double> scale = numbers("scale_factor"); scale.size() == 1) scale_ = scale.front();
  if (const std::vector<double> offset = numbers("add_offset"); offset.size() == 1) offset_ = offset.front();
  is_packed_ = scale_ != 1.0 || offset_ != 0.0;
  for (const char* attribute : {"_FillValue", "missing_value"}) {
    for (const double number : numbers(attribute)) missing_.push_back(as_stored(number));
  }
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

std::vector<double> Packing::numbers(const char* attribute) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file_, variable_, attribute, &type, &length) != NC_NOERR || type == NC_CHAR || type > NC_UINT64) return {};
  std::vector<double> values(length);
  if (nc_get_att_double(file_, variable_, attribute, values.data()) != NC_NOERR) values.clear();
  return values;
}

void Packing::limit(const char* attribute, bool below, bool above) {
  std::vector<double> ends = numbers(attribute);
  if (ends.size() != static_cast<std::size_t>(below) + static_cast<std::size_t>(above)) return;
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
