#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace earshot::own_search {

/// A TOML file that ships, whose values are replaced and whose comments stay: what a key means is said in one place.
/// Keys stand alone on their lines, values on the line of their key.
class TemplateText {
 public:
  /// @param file  for messages
  TemplateText(std::string text, std::filesystem::path file);

  /// The comment before the first empty line says what the file is.
  void set_heading(const std::string& comment);

  /// @param table  "search"; "[port]" for the first `[[port]]` that has the key; "" for what stands before any table
  /// @param value  as TOML has it
  /// @throws BadInput where the table has no such key
  void set(std::string_view table, std::string_view key, const std::string& value);

  [[nodiscard]] std::string text() const;

 private:
  std::string& line_of(std::string_view table, std::string_view key);

  std::vector<std::string> lines_;
  std::filesystem::path file_;
};

/// A number as TOML has it, one that is a fraction: "300.0", "2.5".
[[nodiscard]] std::string toml_number(double value);
/// Text as TOML has it, in quotes.
[[nodiscard]] std::string toml_text(std::string_view text);

}  // namespace earshot::own_search
