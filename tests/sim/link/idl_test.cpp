// The link flattens what several messages hold into the samples of sim.idl. Here each of its fields stands beside the line of the
// dictionary that it repeats, and each line beside its field: a field more on one side alone does not pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "firmware/messages/dictionary/command_fields.hpp"
#include "firmware/messages/dictionary/input_fields.hpp"
#include "firmware/messages/dictionary/output_fields.hpp"

namespace earshot::link {
namespace {

using messages::NumberType;
using Types = std::map<std::string, std::string, std::less<>>;  ///< of fields, by their names, as the IDL writes them

/// The fields of a struct of sim.idl.
Types fields_of(const std::string& name) {
  std::ifstream file(EARSHOT_SOURCE_DIR "/sim/link/sim.idl");
  const std::regex field(R"(^\s+([a-z][a-z ]*[a-z])\s+([a-z0-9_]+);.*)");
  Types fields;
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.find("struct " + name + " {") != std::string::npos) is_inside = true;
    if (line.find("};") != std::string::npos) is_inside = false;
    std::smatch parts;
    if (is_inside && std::regex_match(line, parts, field)) fields.emplace(parts[2], parts[1]);
  }
  return fields;
}

std::string idl_type_of(NumberType type) {
  switch (type) {
    case NumberType::kInt8:
    case NumberType::kByte:
      return "octet";
    case NumberType::kBoolean:
      return "boolean";
    case NumberType::kInt32:
      return "unsigned long";
    case NumberType::kInt64:
      return "unsigned long long";
    case NumberType::kFloat:
      return "float";
    case NumberType::kDouble:
      return "double";
  }
  return "";
}

/// The numbers of a message's lines.
template <class Message>
Types lines_of() {
  Types lines;
  messages::for_each_line<Message>([&lines](const auto& line) {
    if constexpr (requires { line.numbers(); }) {
      for (const messages::NumberField& number : line.numbers()) lines.emplace(number.name, idl_type_of(number.type));
    }
  });
  return lines;
}

/// What a struct of sim.idl repeats of a message: its field, and the line's name in the dictionary.
using Repeated = std::vector<std::pair<std::string, std::string>>;

void expect_same(const Types& fields, const Types& lines, const Repeated& repeated) {
  for (const auto& [field, line] : repeated) {
    ASSERT_TRUE(fields.contains(field)) << "sim.idl has no " << field;
    ASSERT_TRUE(lines.contains(line)) << "the message has no " << line;
    EXPECT_EQ(fields.at(field), lines.at(line)) << field;
  }
}

/// @param left_out  lines that the link does not carry
template <class Message>
void expect_whole(const Types& fields, const Repeated& repeated, const std::set<std::string>& left_out) {
  const Types lines = lines_of<Message>();
  expect_same(fields, lines, repeated);
  for (const auto& [line, type] : lines) {
    const bool is_carried = std::ranges::find(repeated, line, &Repeated::value_type::second) != repeated.end();
    EXPECT_NE(is_carried, left_out.contains(line)) << line << ": does the link carry it or not?";
  }
}

/// Whether a struct of sim.idl has these fields and no others.
void expect_only(const Types& fields, const std::vector<Repeated>& repeated, std::set<std::string> own) {
  for (const Repeated& some : repeated) {
    for (const auto& [field, line] : some) own.insert(field);
  }
  std::set<std::string> names;
  for (const auto& [name, type] : fields) names.insert(name);
  EXPECT_EQ(names, own);
}

TEST(SimulationLinkIdl, TellsOfASoundWhatItsMessagesHold) {
  const Types tick = fields_of("Tick");
  const Repeated snr{{"snr_db", "snr_db"}, {"snr_too_faint", "too_faint"}};
  const Repeated bearing{{"bearing_rad", "bearing_rad"},
                         {"bearing_deviation_rad", "deviation_rad"},
                         {"bearing_ambiguous", "ambiguous"},
                         {"bearing_axis_rad", "axis_rad"}};
  const Repeated status{{"battery_percent", "battery_percent"}};
  const Repeated order{{"command", "command"}};
  expect_whole<messages::SnrMeasurement>(tick, snr, {"utime"});
  expect_whole<messages::BearingMeasurement>(tick, bearing, {"utime", "sender"});
  expect_whole<messages::VehicleStatus>(tick, status, {"utime", "altitude_m", "leak", "ground_fault"});
  expect_same(tick, lines_of<messages::OperatorCommand>(), order);
  expect_only(tick, {snr, bearing, status, order},
              {"run", "number", "time_us", "navigation_messages", "hydrophone_blocks", "snr_valid", "bearing_valid", "battery_valid"});
}

TEST(SimulationLinkIdl, AnswersWhatHealthAndRulesHold) {
  const Types answer = fields_of("Answer");
  const Repeated rule{{"rule", "rule"},
                      {"rule_condition", "condition"},
                      {"rule_response", "response"},
                      {"rule_measure", "measure"},
                      {"rule_limit", "limit"}};
  const Repeated health{{"state", "state"},
                        {"end_reason", "end_reason"},
                        {"steps_taken", "steps_taken"},
                        {"surprise_bits", "surprise_bits"},
                        {"sweeping", "sweeping"},
                        {"found", "found"}};
  const Repeated belief{{"source_north_m", "likeliest_north_m"}, {"source_east_m", "likeliest_east_m"}};
  expect_whole<messages::SafetyEvent>(answer, rule, {"utime", "begins"});
  expect_same(answer, lines_of<messages::Health>(), health);
  expect_same(answer, lines_of<messages::Decision>(), belief);
  expect_only(answer, {rule, health, belief}, {"run", "number", "turns_made", "setpoint_messages", "source_believed", "rule_acted"});
}

}  // namespace
}  // namespace earshot::link
