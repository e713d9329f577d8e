#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace earshot::netcdf {

/// How the numbers that a variable stores become its values, by the attributes of the NetCDF User Guide and of CF:
///
///   value = scale_factor stored + add_offset
///
/// and none (NaN) where the stored number is _FillValue or one of missing_value, or lies outside valid_range, valid_min or valid_max.
/// Without a _FillValue the library's own of the type counts (but of bytes): there nobody has written.
/// `_Unsigned` says that the bits of a signed type are those of an unsigned one, or "false" the reverse: of the attributes' numbers too.
/// An attribute of these that is of another kind (a scale_factor that is a text, or two numbers) counts for nothing, and is a fault.
/// Limits are of the stored numbers, unless they have a floating-point type beside stored integers that are packed: then of the values.
/// Oracle: NetcdfPacking.*
class Packing {
 public:
  /// @param file, variable  the library's own numbers of an open file and of a variable in it
  Packing(int file, int variable);

  [[nodiscard]] double value_of(double stored) const;
  /// Which attribute is no such attribute: "scale_factor: must be one number"; empty: none.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  struct Limits {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    [[nodiscard]] bool allow(double x) const { return !(x < lowest || x > highest); }
  };

  [[nodiscard]] double as_stored(double number) const;
  [[nodiscard]] bool has(const char* attribute) const;
  [[nodiscard]] std::vector<double> numbers(const char* attribute) const;
  /// What a variable has that is of such a kind; nothing where it has none, or another, which is a fault.
  [[nodiscard]] std::vector<double> expect(const char* attribute, std::size_t count, const char* what);
  void limit(const char* attribute, bool below, bool above);

  int file_;
  int variable_;
  int type_ = 0;
  std::string fault_;
  double sign_modulus_ = 0.0;  ///< 2^bits where the type's sign is not the one that is meant
  bool meant_unsigned_ = false;
  double scale_ = 1.0;
  double offset_ = 0.0;
  bool is_packed_ = false;
  std::vector<double> missing_;
  Limits of_stored_;
  Limits of_values_;
};

}  // namespace earshot::netcdf
