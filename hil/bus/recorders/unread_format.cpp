#include "hil/bus/recorders/unread_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "hil/bus/candump/log_fields.hpp"

namespace earshot::hil {

namespace {

struct Kind {
  std::string_view beginning;
  std::string_view what;
};

using namespace std::string_view_literals;

constexpr std::string_view kCapture =
    "is a capture of Wireshark (pcap), which is not read: record with candump -l, or with earshot candump --record";
constexpr std::string_view kPacked = "is compressed: unpack it first, and give it with - where it comes from a pipe";
constexpr std::string_view kWide =
    "is text of two bytes a character (UTF-16), as PowerShell writes it: iconv -f UTF-16 -t UTF-8 makes a log of it";
constexpr std::string_view kSentences = "holds sentences of NMEA 0183, not frames of a CAN bus";

constexpr std::array kBinary{
    Kind{"LOGG"sv,
         "is a BLF log of Vector, which is not read: python-can makes an .asc of it (python3 -m can.logconvert FILE.blf FILE.asc)"sv},
    Kind{"MDF     "sv,
         "is an MDF measurement, which is not read: python-can makes an .asc of it (python3 -m can.logconvert FILE.mf4 FILE.asc)"sv},
    Kind{"\x0A\x0D\x0D\x0A"sv, kCapture},
    Kind{"\xD4\xC3\xB2\xA1"sv, kCapture},
    Kind{"\xA1\xB2\xC3\xD4"sv, kCapture},
    Kind{"\x4D\x3C\xB2\xA1"sv, kCapture},
    Kind{"\xA1\xB2\x3C\x4D"sv, kCapture},
    Kind{"\x1F\x8B"sv, kPacked},
    Kind{"\x28\xB5\x2F\xFD"sv, kPacked},
    Kind{"\xFD\x37\x7A\x58\x5A\x00"sv, kPacked},
    Kind{"BZh"sv, kPacked},
    Kind{"PK\x03\x04"sv, kPacked},
    Kind{"\xFF\xFE"sv, kWide},
    Kind{"\xFE\xFF"sv, kWide},
};

constexpr std::array kText{
    Kind{"timestamp,arbitration_id,"sv,
         "is a CSV of python-can, which is not read: python-can makes a log of it (python3 -m can.logconvert FILE.csv FILE.log)"sv},
    Kind{"Sequence #,"sv, "is a CSV of Garmin, which is not read: canboat's analyzer reads it"sv},
    Kind{"{"sv, "is JSON, of messages that were decoded already"sv},
    Kind{"!PDGY"sv, "is a log of Digital Yacht's iKonvert, which is not read: canboat's analyzer reads it"sv},
    Kind{"$PCDIN"sv, "is a log of Chetco's or Shipmodul's sentences ($PCDIN), which is not read: canboat's analyzer reads it"sv},
    Kind{"$MXPGN"sv, "is a log of Shipmodul's sentences ($MXPGN), which is not read"sv},
};

/// "A173321.107 23FF7 1F513 012F3070002F30709F"
bool is_of_actisense(std::string_view line) {
  return line.starts_with('A') && date_parts(line.substr(1, 11), "000000.000 ").has_value();
}

/// "$GPGGA," or "!AIVDM,"
bool is_sentence(std::string_view line) {
  const bool begins = line.starts_with('$') || line.starts_with('!');
  return begins && line.find(',') == 6 && std::ranges::all_of(line.substr(1, 5), [](unsigned char c) { return std::isupper(c) != 0; });
}

/// "2020-03-04T00:29:58.617 2  13 255 130306 Wind Data:  SID = Unknown; ..."
bool is_of_canboats_analyzer(std::string_view line) {
  if (!date_parts(line.substr(0, 10), "0000-00-00")) return false;
  (void)take_word(line);
  for (int i = 0; i < 4; ++i) {
    if (!number<std::uint32_t>(take_word(line))) return false;
  }
  return true;
}

std::string_view binary_log(std::string_view beginning) {
  const std::string_view first = beginning.substr(0, 64);
  if (first.find('\0') == std::string_view::npos) return "";
  if (first.find("\x1B\x01") != std::string_view::npos)
    return "is an EBL log of Actisense, which is not read: Actisense's EBL Reader exports it as text";
  if (first.find("\x10\x02") != std::string_view::npos)
    return "is what a serial interface sent (Actisense NGT-1, YDNU-02), which is not read: canboat's actisense-serial makes a log of it";
  return "";
}

}  // namespace

std::string_view unread_format(std::string_view beginning) {
  for (const Kind& kind : kBinary) {
    if (beginning.starts_with(kind.beginning)) return kind.what;
  }
  if (const std::string_view what = binary_log(beginning); !what.empty()) return what;
  while (!beginning.empty()) {
    const std::string_view line = take_field(beginning, '\n');
    if (line.starts_with('#') || line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    for (const Kind& kind : kText) {
      if (line.starts_with(kind.beginning)) return kind.what;
    }
    if (is_of_actisense(line)) return "is a log of Actisense (N2K ASCII), which is not read: canboat's analyzer reads it";
    if (is_of_canboats_analyzer(line)) return "is what canboat's analyzer made of a log: messages that were decoded already";
    return is_sentence(line) ? kSentences : "";
  }
  return "";
}

}  // namespace earshot::hil
