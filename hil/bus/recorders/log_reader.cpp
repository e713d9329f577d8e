#include "hil/bus/recorders/log_reader.hpp"

#include <algorithm>
#include <optional>

namespace earshot::hil {

namespace {

using Headed = std::variant<std::monostate, PcanTraceReader, SavvyCanReader, VectorAscReader>;

Headed whose(std::string_view header) {
  if (PcanTraceReader::knows(header)) return PcanTraceReader();
  if (SavvyCanReader::knows(header)) return SavvyCanReader();
  if (VectorAscReader::knows(header)) return VectorAscReader();
  return {};
}

std::optional<LineOr> read_by_header(Headed& headed, std::string_view line) {
  if (auto* const reader = std::get_if<PcanTraceReader>(&headed)) return reader->read(line);
  if (auto* const reader = std::get_if<SavvyCanReader>(&headed)) return reader->read(line);
  if (auto* const reader = std::get_if<VectorAscReader>(&headed)) return reader->read(line);
  return std::nullopt;
}

}  // namespace

LineOr LogReader::read(std::string_view line) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
  if (std::holds_alternative<std::monostate>(headed_)) headed_ = whose(line);
  if (auto read = read_by_header(headed_, line)) return *read;
  if (line.starts_with('#')) canboat_.read_comment(line);
  if (CanboatReader::knows(line)) return canboat_.read(line);
  return YachtDevicesReader::knows(line) ? yacht_devices_.read(line) : read_line(line);
}

}  // namespace earshot::hil
