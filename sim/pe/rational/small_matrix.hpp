#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace earshot::pe {

/// A dense complex matrix of a few columns [rows x columns]. Plain loops serve it: Eigen's blocked solvers take half a minute to compile
/// and are no faster for the 17 columns that a rational fit has at most.
class SmallMatrix {
 public:
  using Complex = std::complex<double>;

  SmallMatrix(std::size_t rows, std::size_t columns) : rows_(rows), values_(rows * columns) {}

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return values_.size() / rows_; }
  [[nodiscard]] Complex& operator()(std::size_t row, std::size_t column) { return values_[column * rows_ + row]; }
  [[nodiscard]] Complex operator()(std::size_t row, std::size_t column) const { return values_[column * rows_ + row]; }
  [[nodiscard]] std::span<Complex> column(std::size_t j) { return std::span(values_).subspan(j * rows_, rows_); }

 private:
  std::size_t rows_;
  std::vector<Complex> values_;  // column by column
};

/// A reflection 1 - 2 v v^H, with |v| = 1, or v = 0: none.
struct Reflector {
  std::vector<SmallMatrix::Complex> v;

  void apply(std::span<SmallMatrix::Complex> x) const;  ///< to as many numbers as v has
  /// M <- M (1 - 2 v v^H), on the columns from `column` on.
  void apply_from_right(SmallMatrix& matrix, std::size_t column) const;
};

/// The reflection that leaves of x its first number alone.
[[nodiscard]] Reflector reflector_of(std::span<const SmallMatrix::Complex> x);

/// A P = Q R by reflections, columns in the order of what is left of their lengths.
/// Source: Golub & Van Loan, Matrix Computations, 4th ed., 5.4.2 (pivoted QR), 8.6 (inverse iteration).   Oracle: PivotedQr.*
class PivotedQr {
 public:
  /// @param matrix  at least as many rows as columns
  explicit PivotedQr(SmallMatrix matrix);

  /// x that minimises |A x - b|; zero for columns that depend on others to within rounding.
  [[nodiscard]] std::vector<SmallMatrix::Complex> least_squares(std::span<const SmallMatrix::Complex> b) const;

  /// x with |x| = 1 that minimises |A x|, by inverse iteration on R until it moves by rounding alone, or for so many iterations.
  [[nodiscard]] std::vector<SmallMatrix::Complex> least_singular_vector(int most_iterations) const;

 private:
  [[nodiscard]] SmallMatrix::Complex pivot(std::size_t k) const;

  SmallMatrix r_;
  std::vector<Reflector> reflectors_;
  std::vector<std::size_t> order_;  // column k of R is column order_[k] of A
};

/// Eigenvalues of a square matrix, by shifted QR steps on its Hessenberg form.
/// Throws std::runtime_error when they do not converge, as for a matrix with NaN.
/// Source: Golub & Van Loan, Matrix Computations, 4th ed., 7.5.   Oracle: Eigenvalues.*
[[nodiscard]] std::vector<SmallMatrix::Complex> eigenvalues(SmallMatrix matrix);

}  // namespace earshot::pe
