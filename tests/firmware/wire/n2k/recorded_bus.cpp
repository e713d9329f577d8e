#include "tests/firmware/wire/n2k/recorded_bus.hpp"

#include <cctype>
#include <fstream>
#include <sstream>

namespace earshot::n2k {

namespace {

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find(separator, begin)) != std::string::npos; begin = end + separator.size())
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// "Heading-To-Steer (Course)" -> "HeadingToSteer"
std::string our_name(const std::string& canboat_name) {
  std::string name;
  bool begins = true;
  for (const char c : canboat_name.substr(0, canboat_name.find('('))) {
    const bool belongs = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (belongs) name += begins ? static_cast<char>(std::toupper(c)) : c;
    begins = !belongs;
  }
  return name;
}

Frame frame_of(const std::string& text) {
  Frame frame;
  const auto parts = split(text, "#");
  frame.identifier = static_cast<std::uint32_t>(std::stoul(parts.at(0), nullptr, 16));
  frame.size = static_cast<std::uint8_t>(parts.at(1).size() / 2);
  for (std::size_t i = 0; i < frame.size; ++i)
    frame.data[i] = static_cast<std::uint8_t>(std::stoul(parts[1].substr(2 * i, 2), nullptr, 16));
  return frame;
}

}  // namespace

std::vector<Recorded> recorded_bus() {
  std::ifstream file(EARSHOT_SOURCE_DIR "/tests/reference/n2k/frames.txt");
  std::vector<Recorded> all;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    const auto columns = split(line, " | ");
    Recorded message;
    message.pgn = static_cast<std::uint32_t>(std::stoul(columns.at(0)));
    for (const std::string& frame : split(columns.at(2), " ")) message.frames.push_back(frame_of(frame));
    message.priority = static_cast<unsigned>(std::stoul(columns.at(3)));
    message.source = static_cast<unsigned>(std::stoul(columns.at(4)));
    message.destination = static_cast<unsigned>(std::stoul(columns.at(5)));
    for (const std::string& field : split(columns.at(6), "; ")) {
      const auto parts = split(field, "=");
      message.fields[our_name(parts.at(0))] = parts.at(1) == "NA" ? std::nullopt : std::optional(std::stod(parts[1]));
    }
    all.push_back(message);
  }
  return all;
}

}  // namespace earshot::n2k
