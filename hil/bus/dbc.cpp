#include "hil/bus/dbc.hpp"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::hil {

namespace {

using n2k::Message;
using n2k::Signal;

constexpr std::uint32_t kExtended = 0x8000'0000U;  ///< DBC's mark of a 29-bit identifier
constexpr int kJ1939Format = 3;                    ///< index in the VFrameFormat enumeration below

bool is_outwards(const Message& message) {
  return message.direction == n2k::Direction::kFromRuntime;
}

/// DBC knows numbers of up to 64 bits; text it does not know.
bool is_in_dbc(const Signal& signal) {
  return signal.kind == Signal::Kind::kNumber;
}

std::uint32_t dbc_identifier(const Message& message) {
  const std::uint8_t source = is_outwards(message) ? n2k::kRuntimeAddress : n2k::kVehicleAddress;
  return n2k::compose({message.pgn, message.priority, source, n2k::kBroadcast}).value() | kExtended;
}

/// Whether it is the first with its identifier: Earshot's own messages of one group are one message to DBC, whose fields hang on "Kind".
bool is_first(const Message& message) {
  for (const Message& other : n2k::messages()) {
    if (dbc_identifier(other) == dbc_identifier(message)) return &other == &message;
  }
  return true;
}

constexpr std::array<std::string_view, 3> kCommonOfKinds{"ManufacturerCode", "IndustryGroup", "Kind"};

bool is_common(const Signal& signal) {
  return std::ranges::find(kCommonOfKinds, signal.name) != kCommonOfKinds.end();
}

void print_signal(std::ostream& out, const Message& message, const Signal& signal) {
  out << " SG_ " << signal.name << ' ';
  if (message.kind != 0 && signal.name == "Kind") out << "M ";
  if (message.kind != 0 && !is_common(signal)) out << 'm' << int{message.kind} << ' ';
  out << ": " << signal.first_bit << '|' << signal.bit_count << "@1" << (signal.sign == Signal::Sign::kSigned ? '-' : '+') << " ("
      << signal.scale.numerator / signal.scale.denominator << ",0) [" << signal.lowest << '|' << signal.highest << "] \"" << signal.unit
      << "\" " << (is_outwards(message) ? "Vehicle\n" : "Earshot\n");
}

void print_message(std::ostream& out, const Message& message) {
  if (!is_first(message)) return;
  out << "\nBO_ " << dbc_identifier(message) << ' ' << message.name << ": " << int{message.size}
      << (is_outwards(message) ? " Earshot\n" : " Vehicle\n");
  for (const Message& other : n2k::messages()) {
    if (dbc_identifier(other) != dbc_identifier(message)) continue;
    for (const Signal& signal : other.signals) {
      if (is_in_dbc(signal) && (&other == &message || !is_common(signal))) print_signal(out, other, signal);
    }
  }
}

void print_comment(std::ostream& out, const Message& message) {
  if (!is_first(message)) return;
  out << "CM_ BO_ " << dbc_identifier(message) << " \"PGN " << message.pgn
      << (message.framing == n2k::Framing::kSingle ? "" : ", several frames (put them together first)");
  if (message.period.us > 0) out << "; stale after " << message.timeout.us / 1000 << " ms";
  out << "\";\n";
}

void print_attributes(std::ostream& out, const Message& message) {
  if (!is_first(message)) return;
  out << "BA_ \"VFrameFormat\" BO_ " << dbc_identifier(message) << ' ' << kJ1939Format << ";\n";
  out << "BA_ \"GenMsgCycleTime\" BO_ " << dbc_identifier(message) << ' ' << message.period.us / 1000 << ";\n";
}

/// Names of raw values: of closed lists, and of those that are no numbers, so that nobody reads "not available" as 655.35 m/s.
void print_names(std::ostream& out, const Message& message) {
  constexpr std::array kNames{"not available", "out of range", "reserved"};
  for (const Signal& signal : message.signals) {
    if (!is_in_dbc(signal) || (signal.choices.empty() && n2k::special_values(signal) == 0)) continue;
    if (!is_first(message) && is_common(signal)) continue;
    out << "VAL_ " << dbc_identifier(message) << ' ' << signal.name;
    for (const n2k::Choice& choice : signal.choices) out << ' ' << choice.raw << " \"" << choice.name << '"';
    for (std::int64_t i = 0; i < n2k::special_values(signal); ++i) {
      out << ' ' << n2k::not_available(signal) - i << " \"" << kNames.at(static_cast<std::size_t>(i)) << '"';
    }
    out << " ;\n";
  }
}

}  // namespace

void print_dbc(std::ostream& out) {
  out.precision(15);
  out << "VERSION \"Generated: earshot dbc > hil/bus/earshot.dbc. Do not edit: change firmware/wire/n2k/table.\"\n\nNS_ "
         ":\n\nBS_:\n\nBU_: Earshot Vehicle\n";
  for (const Message& message : n2k::messages()) print_message(out, message);
  out << '\n';
  for (const Message& message : n2k::messages()) print_comment(out, message);
  out << "\nBA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\",\"J1939PG\";\n"
         "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n"
         "BA_DEF_DEF_ \"VFrameFormat\" \"J1939PG\";\nBA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n";
  for (const Message& message : n2k::messages()) print_attributes(out, message);
  out << '\n';
  for (const Message& message : n2k::messages()) print_names(out, message);
}

}  // namespace earshot::hil
