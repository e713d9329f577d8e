// What Earshot reads and writes on a bus, for a peer in another language: one line asks, one line answers.
//   table                       PGN NAME FRAMING FIELD:FIRST_BIT:BITS:NUMERATOR:DENOMINATOR:LOWEST_RAW:HIGHEST_RAW,... of each standard
//   message, one a line; then "." choices PGN FIELD           RAW=NAME|RAW=NAME|... decode PGN HEX              FIELD=RAW, FIELD=na,
//   FIELD=bad or FIELD="text", tabs between encode PGN FIELD=RAW ...    frames as candump writes them, spaces between; the rest is not
//   available node                        frames of a device that starts and is asked for all that it says of itself stations 129029 HEX
//   TYPE:ID:AGE of each reference station

#include <cstdint>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/node/information.hpp"
#include "firmware/wire/n2k/node/node.hpp"
#include "firmware/wire/n2k/sensors/fields.hpp"
#include "firmware/wire/n2k/text.hpp"

namespace {

using namespace earshot;
using n2k::FieldName;
using n2k::Frame;
using n2k::Message;
using n2k::Signal;

constexpr std::uint8_t kSource = 0x40;

bool is_standard(const Message& message) {
  return !message.name.starts_with("Earshot");
}

std::string candump(const Frame& frame) {
  std::ostringstream out;
  out << std::hex << std::uppercase << std::setfill('0') << std::setw(8) << frame.identifier << '#';
  for (const std::uint8_t byte : frame.bytes()) out << std::setw(2) << int{byte};
  return out.str();
}

std::vector<std::uint8_t> bytes_in(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

void print_table() {
  for (const Message& message : n2k::messages()) {
    if (!is_standard(message)) continue;
    const char* const framing = message.framing == n2k::Framing::kSingle ? "Single"
                                : message.framing == n2k::Framing::kFast ? "Fast"
                                                                         : "ISO";
    std::cout << message.pgn << ' ' << message.name << ' ' << framing << ' ';
    for (const Signal& signal : message.signals) {
      if (signal.kind != Signal::Kind::kVariableText)
        std::cout << signal.name << ':' << signal.first_bit << ':' << signal.bit_count << ':' << signal.scale.numerator << ':'
                  << std::setprecision(17) << signal.scale.denominator << ':' << signal.lowest_raw << ':' << signal.highest_raw << ',';
    }
    std::cout << '\n';
  }
  std::cout << ".\n";
}

void print_choices(const Signal& signal) {
  for (const n2k::Choice& choice : signal.choices) std::cout << choice.raw << '=' << choice.name << '|';
  std::cout << '\n';
}

void print_text(std::string_view name, const Result<std::string_view>& text) {
  std::cout << name << '=';
  if (text.ok()) {
    std::cout << '"' << text.value() << '"';
  } else {
    std::cout << (text.status() == Status::kNotReady ? "na" : "bad");
  }
  std::cout << '\t';
}

void decode_all(const Message& message, const std::vector<std::uint8_t>& bytes) {
  std::span<const std::uint8_t> rest = bytes;
  for (const Signal& signal : message.signals) {
    if (signal.kind == Signal::Kind::kVariableText) {
      print_text(signal.name, n2k::take_variable_text(rest));
    } else if (signal.kind == Signal::Kind::kFixedText) {
      print_text(signal.name, n2k::fixed_text(signal, bytes));
    } else {
      const Result<std::int64_t> raw = decode_raw(signal, bytes);
      std::cout << signal.name << '=';
      if (raw.ok()) {
        std::cout << raw.value();
      } else {
        std::cout << (raw.status() == Status::kNotReady ? "na" : "bad");
      }
      std::cout << '\t';
    }
  }
  std::cout << '\n';
}

void encode_some(const Message& message, std::istream& words) {
  n2k::MessageWriter writer(message);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    writer.set_raw(FieldName(word.substr(0, equals)), std::stoll(word.substr(equals + 1)));
  }
  if (writer.status() != Status::kOk) {
    std::cout << "refused\n";
    return;
  }
  Frame single;
  n2k::FastPacketFrames packet;
  if (message.framing == n2k::Framing::kSingle && writer.frame(kSource, single) == Status::kOk) std::cout << candump(single);
  if (message.framing == n2k::Framing::kFast && compose_fast_packet(writer.identifier(kSource), 3, writer.bytes(), packet) == Status::kOk) {
    for (const Frame& frame : packet) std::cout << candump(frame) << ' ';
  }
  std::cout << '\n';
}

/// TYPE:ID:AGE of each reference station of a 129029, na where it does not say.
void print_stations(const std::vector<std::uint8_t>& bytes) {
  const auto stations = n2k::fields::reference_stations(bytes);
  if (!stations.ok()) {
    std::cout << "bad\n";
    return;
  }
  for (const n2k::ReferenceStation& station : stations.value()) {
    std::cout << (station.type ? std::to_string(*station.type) : "na") << ':' << (station.id ? std::to_string(*station.id) : "na") << ':';
    std::cout << (station.age_s ? std::to_string(*station.age_s) : "na") << ' ';
  }
  std::cout << '\n';
}

void print_node() {
  n2k::Identity identity;
  identity.name = n2k::name_of({.unique_number = 4711}).value();
  identity.product = {
      .code = 7, .model = "Earshot", .software_version = "1.2", .model_version = "A", .serial = "4711", .load_equivalency = 2};
  identity.configuration = {.installation_1 = "stern", .installation_2 = "port side", .manufacturer = "us"};
  n2k::Node node(identity, n2k::table_pgns(n2k::PgnListKind::kTransmitted), n2k::table_pgns(n2k::PgnListKind::kReceived));
  Time now{1'000'000};
  for (int i = 0; i < 20; ++i) {
    n2k::NodeFrames frames;
    node.step(now, frames);
    for (const Frame& frame : frames) std::cout << candump(frame) << ' ';
    now = now + Duration::milliseconds(100);
    for (const std::uint32_t pgn : {126996U, 126998U, 126464U, 126992U}) {
      Frame request{.identifier = 0x18EA4023, .size = 3};
      for (unsigned k = 0; k < 3; ++k) request.data[k] = static_cast<std::uint8_t>(pgn >> (8U * k));
      if (i == 5) node.accept(request, now);
    }
    // A group function (126208) asks for a heartbeat (126993) every second.
    if (i == 5) node.accept(Frame{.identifier = 0x0DED4023, .size = 8, .data = {0x00, 11, 0, 0x11, 0xF0, 0x01, 0xE8, 0x03}}, now);
  }
  std::cout << '\n';
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string verb;
    std::uint32_t pgn = 0;
    words >> verb >> pgn;
    const Message* message = n2k::find_message(pgn);
    if (verb == "table") {
      print_table();
    } else if (verb == "node") {
      print_node();
    } else if (verb == "stations") {
      std::string hex;
      words >> hex;
      print_stations(bytes_in(hex));
    } else if (message == nullptr) {
      std::cout << "unknown\n";
    } else if (verb == "choices") {
      std::string name;
      words >> name;
      print_choices(*find_signal(*message, FieldName(name)));
    } else if (verb == "decode") {
      std::string hex;
      words >> hex;
      decode_all(*message, bytes_in(hex));
    } else {
      encode_some(*message, words);
    }
    std::cout << std::flush;
  }
  return 0;
}
