#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/desk/journal_view/export/export.hpp"

namespace earshot::journal {

/// What an XML 1.0 document may hold of a text, with & < > and quotes spelled out. Control characters become U+FFFD, but for line feed and
/// tab.
/// @param text  UTF-8
[[nodiscard]] std::string xml_text(std::string_view text);

/// An XML document in the making: its elements are closed in the order in which they must be.
class XmlFile {
 public:
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string>>;

  /// Begins it with its declaration.
  explicit XmlFile(PiecewiseFile& file);

  /// An element that others stand in, until its close().
  void open(std::string_view name, Attributes attributes = {});
  void close();
  /// A whole element. @param text  in plain
  void element(std::string_view name, std::string_view text, Attributes attributes = {});
  /// Within the element that is open. @param text  in plain
  void text(std::string_view text) { file_.write(xml_text(text)); }

 private:
  void tag(std::string_view name, Attributes attributes);

  PiecewiseFile& file_;
  std::vector<std::string> open_;
};

}  // namespace earshot::journal
