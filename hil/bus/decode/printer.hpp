#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hil/bus/decode/decoder.hpp"

namespace earshot::hil {

enum class Times : std::uint8_t {
  kAsLogged,  ///< seconds
  kRelative,  ///< seconds since the first message
  kUtc,       ///< "2015-07-10T06:17:32.249713Z"
  kLocal,     ///< "2015-07-10 06:17:32.249713", of this machine's zone
};

/// An empty text for no time.
class TimeWriter {
 public:
  explicit TimeWriter(Times times) : times_(times) {}
  [[nodiscard]] std::string write(std::optional<Time> time);

 private:
  Times times_;
  std::optional<Time> first_;
};

/// Prints messages, one after the other.
class Printer {
 public:
  virtual ~Printer() = default;
  virtual void print(std::ostream& out, const Heard& heard) = 0;
};

enum class Format : std::uint8_t {
  kText,
  kJson,  ///< an object a line
  kCsv,   ///< a row for each signal, under a line of names; RFC 4180 but for the ends of its lines
};

[[nodiscard]] std::unique_ptr<Printer> printer_of(Format format, Times times);

}  // namespace earshot::hil
