#include "hil/bus/dbc.hpp"

#include <array>
#include <ostream>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::hil {

namespace {

using n2k::Message;
using n2k::Signal;

constexpr std::uint32_t kExtended = 0x8000'0000U;  ///< DBC's mark of a 29-bit identifier
constexpr int kJ1939Format = 3;                    ///< index in the VFrameFormat enumeration below

std::uint32_t dbc_identifier(const Message& message) {
  const std::uint8_t source = message.direction == n2k::Direction::kFromRuntime ? n2k::kRuntimeAddress : n2k::kVehicleAddress;
  return n2k::compose({message.pgn, message.priority, source, n2k::kBroadcast}).value() | kExtended;
}

void print_message(std::ostream& out, const Message& message) {
  const bool outwards = message.direction == n2k::Direction::kFromRuntime;
  out << "\nBO_ " << dbc_identifier(message) << ' ' << message.name << ": " << int{message.size}
      << (outwards ? " Earshot\n" : " Vehicle\n");
  for (const Signal& signal : message.signals) {
    out << " SG_ " << signal.name << " : " << signal.first_bit << '|' << int{signal.bit_count} << "@1"
        << (signal.sign == Signal::Sign::kSigned ? '-' : '+') << " (" << signal.scale << ',' << signal.offset << ") [" << signal.lowest
        << '|' << signal.highest << "] \"" << signal.unit << "\" " << (outwards ? "Vehicle\n" : "Earshot\n");
  }
}

void print_comment(std::ostream& out, const Message& message) {
  out << "CM_ BO_ " << dbc_identifier(message) << " \"PGN " << message.pgn
      << (message.size > 8 ? ", fast packet (put its frames together first)" : "") << "; stale after " << message.timeout.us / 1000
      << " ms\";\n";
}

/// Names for the raw values that are no numbers, so that nobody reads "not available" as 655.35 m/s.
void print_special_values(std::ostream& out, const Message& message) {
  constexpr std::array kNames{"not available", "out of range", "reserved"};
  for (const Signal& signal : message.signals) {
    out << "VAL_ " << dbc_identifier(message) << ' ' << signal.name;
    for (std::int64_t i = 0; i < n2k::special_values(signal); ++i) {
      out << ' ' << n2k::not_available(signal) - i << " \"" << kNames.at(static_cast<std::size_t>(i)) << '"';
    }
    out << " ;\n";
  }
}

}  // namespace

void print_dbc(std::ostream& out) {
  out.precision(15);
  out << "VERSION \"Generated: earshot dbc > hil/bus/earshot.dbc. Do not edit: change firmware/wire/n2k/signals.cpp.\"\n\nNS_ "
         ":\n\nBS_:\n\nBU_: Earshot Vehicle\n";
  for (const Message& message : n2k::messages()) print_message(out, message);
  out << '\n';
  for (const Message& message : n2k::messages()) print_comment(out, message);
  out << "\nBA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\",\"J1939PG\";\n"
         "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n"
         "BA_DEF_DEF_ \"VFrameFormat\" \"J1939PG\";\nBA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n";
  for (const Message& message : n2k::messages()) {
    out << "BA_ \"VFrameFormat\" BO_ " << dbc_identifier(message) << ' ' << kJ1939Format << ";\n";
    out << "BA_ \"GenMsgCycleTime\" BO_ " << dbc_identifier(message) << ' ' << message.period.us / 1000 << ";\n";
  }
  out << '\n';
  for (const Message& message : n2k::messages()) print_special_values(out, message);
}

}  // namespace earshot::hil
