#include "hil/bus/decode/value.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <optional>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/wire/n2k/text.hpp"
#include "hil/bus/decode/text.hpp"

namespace earshot::hil {

namespace {

using n2k::Message;
using n2k::Signal;

/// A raw step of 1e-4 rad is 0.006 degrees.
std::string in_degrees(double radians) {
  return host::decimals(radians * 180.0 / std::numbers::pi, 2) + " deg";
}

/// The field as its bits stand, with no raw value taken for anything but a number.
Result<std::int64_t> plain_raw(Signal signal, std::span<const std::uint8_t> bytes) {
  signal.special_count = 0;
  signal.lowest_raw = std::numeric_limits<std::int64_t>::min();
  signal.highest_raw = std::numeric_limits<std::int64_t>::max();
  return n2k::decode_raw(signal, bytes);
}

Value::Kind special_kind(const Signal& signal, std::int64_t raw) {
  constexpr std::array kKinds{Value::Kind::kNotAvailable, Value::Kind::kOutOfRange, Value::Kind::kReserved};
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const auto nth = static_cast<std::int64_t>(i);
    if (nth < n2k::special_values(signal) && raw == n2k::not_available(signal) - nth) return kKinds.at(i);
  }
  return raw < signal.lowest_raw || raw > signal.highest_raw ? Value::Kind::kNotAllowed : Value::Kind::kNumber;
}

void read_number(const Signal& signal, std::span<const std::uint8_t> bytes, Value& value) {
  const Result<std::int64_t> raw = plain_raw(signal, bytes);
  if (!raw.ok()) {
    value.kind = Value::Kind::kMissing;
    return;
  }
  value.kind = special_kind(signal, raw.value());
  value.number = static_cast<double>(raw.value()) * signal.scale.numerator / signal.scale.denominator;
  if (value.kind == Value::Kind::kNumber && !signal.choices.empty()) {
    const auto choice = std::ranges::find(signal.choices, raw.value(), &n2k::Choice::raw);
    if (choice == signal.choices.end()) return;
    value.kind = Value::Kind::kWord;
    value.text = choice->name;
  }
}

void read_fixed_text(const Signal& signal, std::span<const std::uint8_t> bytes, Value& value) {
  const Result<std::string_view> text = n2k::fixed_text(signal, bytes);
  value.kind = text.ok() ? Value::Kind::kText : text.status() == Status::kNotReady ? Value::Kind::kNotAvailable : Value::Kind::kMissing;
  if (text.ok()) value.text = text.value();
}

Value read_field(const Signal& signal, std::span<const std::uint8_t> bytes, std::span<const std::uint8_t>& texts) {
  Value value{.name = std::string(signal.name), .unit = signal.unit};
  if (signal.kind == Signal::Kind::kNumber) {
    read_number(signal, bytes, value);
  } else if (signal.kind == Signal::Kind::kFixedText) {
    read_fixed_text(signal, bytes, value);
  } else if (texts.empty()) {
    value.kind = Value::Kind::kMissing;
  } else {
    const std::optional<std::string> text = take_text(texts);
    value.kind = !text ? Value::Kind::kUnreadable : text->empty() ? Value::Kind::kNotAvailable : Value::Kind::kText;
    if (text) value.text = *text;
  }
  return value;
}

/// Behind the last field of a GNSS position come the reference stations, as many as it says, as far as the message goes.
void add_reference_stations(const Message& message, std::span<const std::uint8_t> bytes, std::vector<Value>& values) {
  const auto count = n2k::decode_raw(*n2k::find_signal(message, "ReferenceStations"), bytes);
  if (!count.ok()) return;
  std::span<const std::uint8_t> no_texts;
  for (std::int64_t nth = 0; nth < count.value(); ++nth) {
    const std::size_t first = message.size + static_cast<std::size_t>(nth) * n2k::table::kReferenceStationBytes;
    const auto station = bytes.subspan(std::min(first, bytes.size()));
    for (const Signal& signal : n2k::table::kReferenceStationSignals) {
      values.push_back(read_field(signal, station, no_texts));
      if (nth > 0) values.back().name += "[" + std::to_string(nth) + "]";
    }
    if (station.empty()) return;
  }
}

}  // namespace

std::vector<Value> values_of(const Message& message, std::span<const std::uint8_t> bytes) {
  std::vector<Value> values;
  std::span<const std::uint8_t> texts = bytes;
  for (const Signal& signal : message.signals) values.push_back(read_field(signal, bytes, texts));
  if (message.pgn == n2k::kGnssPgn) add_reference_stations(message, bytes, values);
  if (message.repeated_bytes == 0) return values;
  const unsigned repeated_from = 8U * (message.size - message.repeated_bytes);
  for (std::size_t nth = 1; message.size + nth * message.repeated_bytes <= bytes.size(); ++nth) {
    for (const Signal& signal : message.signals) {
      if (signal.first_bit < repeated_from) continue;
      values.push_back(read_field(signal, bytes.subspan(nth * message.repeated_bytes), texts));
      values.back().name += "[" + std::to_string(nth) + "]";
    }
  }
  return values;
}

std::string without_unit(const Value& value) {
  switch (value.kind) {
    case Value::Kind::kNumber:
      return host::shortest(value.number);
    case Value::Kind::kWord:
      return value.text;
    case Value::Kind::kText:
      return host::printable(value.text);
    case Value::Kind::kNotAvailable:
      return "not available";
    case Value::Kind::kOutOfRange:
      return "out of range";
    case Value::Kind::kReserved:
      return "reserved";
    case Value::Kind::kNotAllowed:
      return "not allowed: " + host::shortest(value.number);
    case Value::Kind::kUnreadable:
      return "unreadable";
    case Value::Kind::kMissing:
      return "missing";
  }
  return {};
}

std::string to_string(const Value& value) {
  if (value.kind == Value::Kind::kText) return '"' + without_unit(value) + '"';
  const bool has_unit = value.kind == Value::Kind::kNumber || value.kind == Value::Kind::kNotAllowed;
  std::string text = without_unit(value) + (has_unit && !value.unit.empty() ? " " + std::string(value.unit) : "");
  if (value.kind == Value::Kind::kNumber && value.unit == "rad") text += " (" + in_degrees(value.number) + ")";
  return text;
}

}  // namespace earshot::hil
