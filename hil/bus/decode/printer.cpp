#include "hil/bus/decode/printer.hpp"

#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <ostream>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::hil {

namespace {

using Json = nlohmann::ordered_json;
constexpr std::int64_t kMicroseconds = 1'000'000;

std::string in_hexadecimal(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

std::string in_seconds(std::int64_t us) {
  const std::int64_t size = us < 0 ? -us : us;
  return host::formatted("%s%lld.%06lld", us < 0 ? "-" : "", static_cast<long long>(size / kMicroseconds),
                         static_cast<long long>(size % kMicroseconds));
}

std::string as_date(std::int64_t us, bool is_local) {
  const std::time_t seconds = us / kMicroseconds;
  std::tm date{};
  if ((is_local ? ::localtime_r(&seconds, &date) : ::gmtime_r(&seconds, &date)) == nullptr) return in_seconds(us);
  std::array<char, 64> text{};
  if (std::strftime(text.data(), text.size(), is_local ? "%Y-%m-%d %H:%M:%S" : "%Y-%m-%dT%H:%M:%S", &date) == 0) return in_seconds(us);
  return text.data() + in_seconds(us % kMicroseconds).substr(1) + (is_local ? "" : "Z");
}

class TextPrinter : public Printer {
 public:
  explicit TextPrinter(Times times) : times_(times) {}

  void print(std::ostream& out, const Heard& heard) override {
    const std::string time = times_.write(heard.time);
    const n2k::Identifier& id = heard.identifier;
    out << (time.empty() ? "-" : time) << ' ' << host::printable(heard.interface) << ' ' << int{id.source};
    if (!heard.source_name.empty()) out << " (" << host::printable(heard.source_name) << ')';
    if (id.destination != n2k::kBroadcast) out << " to " << int{id.destination};
    out << ": " << id.pgn << ' ';
    if (heard.message == nullptr) {
      out << "unknown " << in_hexadecimal(heard.bytes) << '\n';
      return;
    }
    out << heard.message->name;
    for (const Value& value : heard.values) {
      out << (&value == heard.values.data() ? ": " : ", ") << value.name << " = " << to_string(value);
    }
    out << '\n';
  }

 private:
  TimeWriter times_;
};

class JsonPrinter : public Printer {
 public:
  explicit JsonPrinter(Times times) : times_(times), is_number_(times == Times::kAsLogged || times == Times::kRelative) {}

  void print(std::ostream& out, const Heard& heard) override {
    const std::string time = times_.write(heard.time);
    const n2k::Identifier& id = heard.identifier;
    Json line{{"time", time.empty() ? Json()
                       : is_number_ ? Json(std::stod(time))
                                    : Json(time)},
              {"interface", host::printable(heard.interface)},
              {"source", id.source},
              {"name", heard.source_name.empty() ? Json() : Json(host::printable(heard.source_name))},
              {"destination", id.destination},
              {"priority", id.priority},
              {"pgn", id.pgn},
              {"message", heard.message == nullptr ? Json() : Json(heard.message->name)}};
    if (heard.message == nullptr) line["data"] = in_hexadecimal(heard.bytes);
    for (const Value& value : heard.values) line["signals"][value.name] = json_of(value);
    out << line << '\n';
  }

 private:
  /// What is no value is null, and says beside it why.
  static Json json_of(const Value& value) {
    Json json{{"value", nullptr}};
    if (value.kind == Value::Kind::kNumber) {
      json["value"] = value.number;
    } else if (value.kind == Value::Kind::kWord || value.kind == Value::Kind::kText) {
      json["value"] = without_unit(value);
    } else {
      json["why"] = without_unit(value);
    }
    if (!value.unit.empty()) json["unit"] = value.unit;
    return json;
  }

  TimeWriter times_;
  bool is_number_;
};

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

class CsvPrinter : public Printer {
 public:
  explicit CsvPrinter(Times times) : times_(times) {}

  void print(std::ostream& out, const Heard& heard) override {
    if (!has_head_) out << "time,interface,source,destination,priority,pgn,message,signal,value,unit\n";
    has_head_ = true;
    const n2k::Identifier& id = heard.identifier;
    const std::string head = times_.write(heard.time) + ',' + quoted(host::printable(heard.interface)) + ',' + std::to_string(id.source) +
                             ',' + std::to_string(id.destination) + ',' + std::to_string(id.priority) + ',' + std::to_string(id.pgn) + ',';
    if (heard.message == nullptr) out << head << ",data," << in_hexadecimal(heard.bytes) << ",\n";
    for (const Value& value : heard.values) {
      out << head << heard.message->name << ',' << value.name << ',' << quoted(without_unit(value)) << ','
          << quoted(std::string(value.unit)) << '\n';
    }
  }

 private:
  TimeWriter times_;
  bool has_head_ = false;
};

}  // namespace

std::string TimeWriter::write(std::optional<Time> time) {
  if (!time) return {};
  if (!first_) first_ = time;
  switch (times_) {
    case Times::kAsLogged:
      return in_seconds(time->us);
    case Times::kRelative:
      return in_seconds(time->us - first_->us);
    case Times::kUtc:
      return as_date(time->us, false);
    case Times::kLocal:
      return as_date(time->us, true);
  }
  return {};
}

std::unique_ptr<Printer> printer_of(Format format, Times times) {
  switch (format) {
    case Format::kText:
      return std::make_unique<TextPrinter>(times);
    case Format::kJson:
      return std::make_unique<JsonPrinter>(times);
    case Format::kCsv:
      return std::make_unique<CsvPrinter>(times);
  }
  return nullptr;
}

}  // namespace earshot::hil
