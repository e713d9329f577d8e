#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/toml/range.hpp"

namespace earshot::ocean {

/// A file that another propagation model reads, or a file beside it.
inline constexpr host::FileKind kModelFile{"an input file of a propagation model", std::uint64_t{16} << 20U};

/// Reads a text as Fortran programs read theirs: by list-directed READ statements, each of which begins on a line of its own.
///
/// A READ takes values as they come, from as many lines as it needs, and leaves what stands behind the last on its line: people write
/// comments there. Values stand apart by blanks or a comma; nothing between two commas, or a slash, which ends the READ, leaves a value as
/// it was; 3*0.5 stands for three values; 1.5D3 is a number.
/// Source: Fortran 2018 (ISO/IEC 1539-1:2018), 13.10.3. Deviations: a text without quotes is one word; complex numbers and logicals are
/// refused. Oracle: ListReader.*
class ListReader {
 public:
  /// Throws host::BadInput as host::read_text does.
  explicit ListReader(const std::filesystem::path& path);
  /// @param path  stands for the text in what is wrong with it
  ListReader(std::filesystem::path path, std::string text);

  /// One READ of numbers. Those that the file leaves out stay as they were. @return how many values, at most, were given or passed over
  /// @param what  names them in what is wrong: "zs"
  std::size_t numbers(std::span<double> values, const std::string& what);
  /// One READ of one number, which must be there.
  [[nodiscard]] double number(const std::string& what, host::Range allowed);
  /// Likewise a whole number.
  [[nodiscard]] std::size_t count(const std::string& what, std::size_t least, std::size_t most);
  /// One READ of a text, in quotes or of one word.
  [[nodiscard]] std::string text(const std::string& what);
  /// A text, then numbers behind it, of one READ.
  [[nodiscard]] std::string text_and_numbers(const std::string& what, std::span<double> values);
  /// The whole next line, whatever it holds, empty too, without quotes about it.
  [[nodiscard]] std::string line(const std::string& what);

  /// Goes to what comes next, on this line or a later one.
  void skip_blanks();
  /// How many numbers the next line that is not empty begins with.
  [[nodiscard]] std::size_t numbers_ahead() const;
  /// Whether nothing but blanks is left.
  [[nodiscard]] bool at_end() const;

  /// An error about the line read last: "FILE:LINE: WHAT = VALUE: MUST".
  [[nodiscard]] host::BadInput error(const std::string& what, const std::string& value, const std::string& must) const;
  [[nodiscard]] host::BadInput error(const std::string& what, double value, const std::string& must) const;
  /// Throws the error of a value that is not allowed.
  void require(const std::string& what, double value, host::Range allowed) const;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Of the value that was read last, from 1.
  [[nodiscard]] std::size_t line_number() const { return line_; }

 private:
  struct Item {
    std::string text;
    bool is_quoted = false;
    bool is_null = false;
  };
  /// The next value; nothing behind a slash. Throws at the end of the file.
  std::optional<Item> next_item(const std::string& what);
  [[nodiscard]] std::string quoted(const std::string& what);
  void begin();
  void end_of_read();

  std::filesystem::path path_;
  std::string text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;       ///< of the value read last
  std::size_t next_line_ = 1;  ///< of text_[at_]
  bool after_comma_ = true;    ///< a comma now stands for a value left out
};

}  // namespace earshot::ocean
