#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace earshot::recording {

/// Reads words and numbers off the front of a text. After the first that is not there all further reads fail.
class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : rest_(text) {}

  /// Passes over everything up to the end of `word`.
  TextScanner& after(std::string_view word);
  /// Passes over `word`, which must come next.
  TextScanner& word(std::string_view word);
  /// A number of exactly so many digits.
  TextScanner& digits(std::size_t count, int& number);
  /// A whole number with its sign, at most nine digits.
  TextScanner& integer(int& number);
  /// A decimal fraction with its sign, in the C locale.
  TextScanner& decimal(double& number);
  TextScanner& blanks();

  [[nodiscard]] bool is_ok() const { return is_ok_; }
  [[nodiscard]] bool comes_next(std::string_view word) const { return is_ok_ && rest_.starts_with(word); }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  TextScanner& fail();

  std::string_view rest_;
  bool is_ok_ = true;
};

}  // namespace earshot::recording
