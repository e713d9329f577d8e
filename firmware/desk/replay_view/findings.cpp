#include "firmware/desk/replay_view/findings.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::replay_view {
namespace {

using board::Playback;
using board::ReplayResult;
using End = host::JournalReader::End;

std::string what_is_wrong(const Playback::Difference& difference) {
  if (!difference.now) return "no output has its place there, and it is no input that can be read";
  if (difference.now->channel != difference.channel) return "the runtime gives " + std::string(difference.now->channel) + " there now";
  return to_string(fields_of(difference));
}

std::string damage_to_string(const ReplayResult& result, std::size_t i) {
  const bool is_end = result.end != End::kWhole && i + 1 == result.damages.size();
  if (!is_end) return journal::to_string(result.damages[i]);
  return to_string(journal::TornEnd{.where = result.damages[i], .is_cut = result.end == End::kCut});
}

/// Of the record, as the journal's files for other programs name it.
FieldDifference date_difference(Time then, Time now) {
  constexpr int kMicroseconds = 6;
  return {.field = "time_s",
          .then = host::decimals(journal::seconds_of(then), kMicroseconds),
          .now = host::decimals(journal::seconds_of(now), kMicroseconds)};
}

/// What follows a difference or a gap is not given to the runtime, which would not be as it was.
constexpr const char* kRestIsOpen = "; what follows was not given again";

}  // namespace

std::string figures(const ReplayResult& result, double took_s) {
  const double mission_s = static_cast<double>((result.ended - result.began).us) / 1e6;
  return host::counted(result.inputs, "input") + ", " + host::counted(result.turns, "turn") + " and " +
         host::counted(result.decisions, "decision") +
         host::formatted("; %.1f s of mission in %.2f s, %.0f times real time", mission_s, took_s, mission_s / std::max(took_s, 1e-6));
}

std::vector<FieldDifference> fields_of(const Playback::Difference& difference) {
  if (!difference.now || difference.now->channel != difference.channel) return {};
  std::vector<FieldDifference> differences = field_differences(difference.channel, difference.data, difference.now->message.bytes());
  if (difference.time != difference.now->time) differences.push_back(date_difference(difference.time, difference.now->time));
  return differences;
}

std::string to_string(const Playback::Difference& difference, Time began) {
  return "record " + std::to_string(difference.record) + ", " + host::printable(difference.channel) +
         host::formatted(" at %.3f s: ", journal::seconds_of(Time{(difference.time - began).us})) + what_is_wrong(difference);
}

std::vector<std::string> findings(const ReplayResult& result) {
  constexpr std::size_t kMostDamages = 10;
  std::vector<std::string> lines;
  if (result.difference) lines.push_back(to_string(*result.difference, result.began) + kRestIsOpen);
  if (result.gap) lines.push_back("record " + std::to_string(*result.gap) + " is missing" + kRestIsOpen);
  if (result.records_behind_end > 0)
    lines.push_back("behind the record that ends the journal: " + host::counted(result.records_behind_end, "record") +
                    " of something else, not given again");
  for (std::size_t i = 0; i < std::min(kMostDamages, result.damages.size()); ++i) lines.push_back(damage_to_string(result, i));
  if (result.damages.size() > kMostDamages)
    lines.push_back("and " + host::counted(result.damages.size() - kMostDamages, "damaged place") + " more");
  if (!result.closing && !result.difference)
    lines.emplace_back("the journal's end is missing: its program was killed, lost its power, or writes it still");
  return lines;
}

std::string praise(const ReplayResult& result, std::uint32_t from_step) {
  const bool is_all = result.is_same() && result.closing && result.records_behind_end == 0 && result.damages.empty();
  const std::string which = from_step == 0 ? "every output" : "every output from step " + std::to_string(from_step) + " on";
  return which + (is_all ? "" : " up to there") + " is the same, byte for byte";
}

}  // namespace earshot::replay_view
