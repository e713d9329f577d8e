#include "firmware/desk/journal_view/export/maps/xml.hpp"

namespace earshot::journal {

std::string xml_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else if (c == '"')
      safe += "&quot;";
    else if (byte < 0x20 && c != '\n' && c != '\t')
      safe += "\xEF\xBF\xBD";
    else
      safe += c;
  }
  return safe;
}

XmlFile::XmlFile(PiecewiseFile& file) : file_(file) {
  file_.write(R"(<?xml version="1.0" encoding="UTF-8"?>)");
}

void XmlFile::tag(std::string_view name, Attributes attributes) {
  std::string tag = "\n<" + std::string(name);
  for (const auto& [key, value] : attributes) tag += " " + std::string(key) + "=\"" + xml_text(value) + "\"";
  file_.write(tag + ">");
}

void XmlFile::open(std::string_view name, Attributes attributes) {
  tag(name, attributes);
  open_.emplace_back(name);
}

void XmlFile::close() {
  file_.write("</" + open_.back() + ">");
  open_.pop_back();
  if (open_.empty()) file_.write("\n");
}

void XmlFile::element(std::string_view name, std::string_view content, Attributes attributes) {
  tag(name, attributes);
  text(content);
  file_.write("</" + std::string(name) + ">");
}

}  // namespace earshot::journal
