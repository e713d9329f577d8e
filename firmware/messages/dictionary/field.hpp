#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "firmware/messages/dictionary/bus_signal.hpp"
#include "firmware/messages/dictionary/member.hpp"
#include "firmware/messages/dictionary/number.hpp"

namespace earshot::messages {

// One line of a message's list: a field, how it is called and told, and which plain numbers it is made of. `tell` gives these numbers, in
// their order, `hear` takes them; who turns numbers into bytes is firmware/wire.

/// How a number is laid out there (bus_signal.hpp).
namespace on_bus = n2k::table;

/// Bytes on the bus: numbers of four bytes each, little-endian, one behind the other.
struct BusWords {
  std::array<n2k::Signal, 8> signals{};
  std::size_t count = 0;
};
template <class... Names>
consteval BusWords bus_words(unsigned first_bit, Names... names) {
  BusWords words;
  for (const std::string_view name : {std::string_view(names)...}) {
    words.signals[words.count] = n2k::table::any_number(name, first_bit + 32 * static_cast<unsigned>(words.count));
    ++words.count;
  }
  return words;
}

/// How a field is told besides its name.
struct FieldFormat {
  std::string_view meaning = {};  ///< for who reads the message's definition or a schema
  std::string_view key = {};      ///< in files; empty: its name
  std::string_view heading = {};  ///< a line of its own before it, in the definition: what begins here
  std::string_view group = {};    ///< in files it stands in an object of this name, without the name's part of its own
  bool is_in_files = true;
  bool is_checksum = false;               ///< in files it is written in hexadecimal digits
  bool counts_from_one_in_files = false;  ///< where the message counts from 0
  /// In the definition stand the names of its values, too (of an enum with words): as they are; behind the field's name; or behind it where
  /// another field of the message has a value of that name.
  enum class Values : std::uint8_t { kNone, kPlain, kPrefixed, kPrefixedIfTaken } values = Values::kNone;
  n2k::Signal bus = {};     ///< its place in its own NMEA 2000 group (firmware/wire/n2k/table); without a name: no such group carries it
  BusWords bus_words = {};  ///< likewise, of bytes
  bool is_later_on_bus = false;   ///< senders of before do not have it: what is not there stays as it is
  bool saturates_on_bus = false;  ///< what its place cannot hold is told as the nearest that it can, and a NaN as not available
};

/// What a number of a message is called, and how many there are of it.
struct NumberField {
  NumberType type = NumberType::kInt8;
  std::string_view name;
  std::array<std::size_t, 2> sizes{};  ///< of an array of one dimension, or of two; 0: none
  std::string_view counted_by = {};    ///< of an array that has no fixed size: the field that says it
};

struct Line {
  std::string_view name;
  FieldFormat format;
};

/// One number; zero of what is missing.
template <class At>
struct Scalar : Line {
  using Place = At;
  using Reaches = Types<Place>;
  using Value = typename detail::WithoutOptional<typename Place::Value>::Type;
  using Number = Plain<Value>;

  /// Null: it is not there.
  static constexpr auto* value_in(auto& message) {
    auto* const place = Place::in(message);
    if constexpr (kIsOptional<typename Place::Value>) {
      return place != nullptr && *place ? &**place : nullptr;
    } else {
      return place;
    }
  }

  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = type_of<Number>(), .name = name}}}; }

  static constexpr void write(const auto& message, auto& out) {
    const Value* const value = value_in(message);
    out.number(value != nullptr ? plain(*value) : Number{});
  }
  static constexpr void hear(auto& in, auto& message) {
    const auto number = in.template number<Number>();
    if (Value* const value = value_in(message)) *value = made_of<Value>(number);
  }
};

/// One number, which is a byte to others.
template <class Place>
struct ByteScalar : Scalar<Place> {
  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = NumberType::kByte, .name = this->name}}}; }
};

/// Whether something is there; what is in it has lines of its own, behind this one.
template <class At>
struct Presence : Line {
  using Place = At;
  using Reaches = Types<Place>;

  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = NumberType::kBoolean, .name = name}}}; }

  static constexpr void write(const auto& message, auto& out) {
    const auto* const value = Place::in(message);
    out.number(value != nullptr && value->has_value());
  }
  static constexpr void hear(auto& in, auto& message) {
    const bool is_there = in.template number<bool>();
    auto* const value = Place::in(message);
    if (value != nullptr && is_there) value->emplace();
  }
};

/// A number that may be missing: NaN then.
template <class At>
struct OptionalNumber : Line {
  using Place = At;
  using Reaches = Types<Place>;
  using Value = typename Place::Value::value_type;
  static constexpr bool kIsOptional = true;

  /// Null: it is missing.
  static constexpr const Value* value_in(const auto& message) {
    const auto* const value = Place::in(message);
    return value != nullptr && value->has_value() ? &**value : nullptr;
  }

  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = NumberType::kDouble, .name = name}}}; }

  static constexpr void write(const auto& message, auto& out) {
    const auto* const value = Place::in(message);
    const bool is_there = value != nullptr && value->has_value();
    out.number(is_there ? plain(**value) : std::numeric_limits<double>::quiet_NaN());
  }
  static constexpr void hear(auto& in, auto& message) {
    const auto number = in.template number<double>();
    auto* const value = Place::in(message);
    if (value != nullptr && number == number) *value = made_of<Value>(number);
  }
};

/// Bytes of a fixed number.
template <class At>
struct Bytes : Line {
  using Place = At;
  using Reaches = Types<Place>;
  static constexpr std::size_t kSize = std::tuple_size_v<typename Place::Value>;

  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const {
    return {{{.type = NumberType::kByte, .name = name, .sizes = {kSize, 0}}}};
  }

  static constexpr void write(const auto& message, auto& out) {
    for (const std::uint8_t byte : *Place::in(message)) out.number(byte);
  }
  static constexpr void hear(auto& in, auto& message) {
    for (std::uint8_t& byte : *Place::in(message)) byte = in.template number<std::uint8_t>();
  }
};

/// Text in bytes, zeros behind it.
template <class Place>
struct Text : Bytes<Place> {};

/// As many floats as others expect, kOutside, whatever there is room for here: zeros are told of what is not there, and what there is no
/// room for is passed over. How many of them count has a line of its own.
template <class Place, class Count, std::size_t kOutside>
struct Floats : Line {
  using Reaches = Types<Place>;
  using Counted = Count;

  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const {
    return {{{.type = NumberType::kFloat, .name = name, .sizes = {kOutside, 0}}}};
  }

  static constexpr void write(const auto& message, auto& out) {
    const auto& floats = *Place::in(message);
    for (std::size_t i = 0; i < kOutside; ++i) out.number(i < floats.size() ? floats[i] : 0.0F);
  }
  static constexpr void hear(auto& in, auto& message) {
    auto& floats = *Place::in(message);
    for (std::size_t i = 0; i < kOutside; ++i) {
      const auto number = in.template number<float>();
      if (i < floats.size()) floats[i] = number;
    }
  }
};

/// How many there are of what stands in a line of its own behind it. More than there is room for are cut off.
template <class At>
struct Count : Line {
  using Place = At;
  using Reaches = Types<Place>;
  static constexpr bool kIsCount = true;
  using Element = std::remove_cvref_t<decltype(std::declval<typename Place::Value&>()[0])>;

  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = NumberType::kInt8, .name = name}}}; }

  static constexpr void write(const auto& message, auto& out) { out.number(static_cast<std::int8_t>(Place::in(message)->size())); }
  static constexpr void hear(auto& in, auto& message) {
    auto& elements = *Place::in(message);
    elements.clear();
    const int count = std::min<int>(in.template number<std::int8_t>(), static_cast<int>(elements.capacity()));
    for (int i = 0; i < count; ++i) static_cast<void>(elements.push_back(Element{}));  // there is room
  }
};

/// Messages in a message, always as many as there is room for. How many of them count stands before them.
template <class Place>
struct Nested : Line {
  using Reaches = Types<Place>;
  using Element = typename Count<Place>::Element;
  static constexpr std::size_t kSize = Place::Value::capacity();

  static constexpr void write(const auto& message, auto& out) {
    const auto& elements = *Place::in(message);
    for (const Element& element : elements) out.message(element);
    for (std::size_t i = elements.size(); i < kSize; ++i) out.template zeros<Element>();
  }
  static constexpr void hear(auto& in, auto& message) {
    auto& elements = *Place::in(message);
    for (Element& element : elements) in.message(element);
    for (std::size_t i = elements.size(); i < kSize; ++i) in.template pass_over<Element>();
  }
};

/// When the message was sent, which it does not hold itself.
struct SentTime : Line {
  using Reaches = Types<>;
  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = NumberType::kInt64, .name = name}}}; }
};

/// A member that nobody is told.
template <class... Places>
struct Unpublished : Line {
  using Reaches = Types<Places...>;
  [[nodiscard]] constexpr std::array<NumberField, 0> numbers() const { return {}; }
  static constexpr void write(const auto& /*message*/, auto& /*out*/) {}
  static constexpr void hear(auto& /*in*/, auto& /*message*/) {}
};

// Words to write lists with.

template <auto... kSteps>
consteval auto field(std::string_view name, FieldFormat format = {}) {
  return Scalar<At<kSteps...>>{{name, format}};
}
template <auto... kSteps>
consteval auto byte_field(std::string_view name, FieldFormat format = {}) {
  return ByteScalar<At<kSteps...>>{{{name, format}}};
}
template <auto... kSteps>
consteval auto whether_there(std::string_view name, FieldFormat format = {}) {
  return Presence<At<kSteps...>>{{name, format}};
}
template <auto... kSteps>
consteval auto optional_field(std::string_view name, FieldFormat format = {}) {
  return OptionalNumber<At<kSteps...>>{{name, format}};
}
template <auto... kSteps>
consteval auto bytes(std::string_view name, FieldFormat format = {}) {
  return Bytes<At<kSteps...>>{{name, format}};
}
template <auto... kSteps>
consteval auto text(std::string_view name, FieldFormat format = {}) {
  return Text<At<kSteps...>>{{{name, format}}};
}
template <auto kFloats, auto kCount, std::size_t kOutside>
consteval auto floats(std::string_view name, FieldFormat format = {}) {
  return Floats<At<kFloats>, At<kCount>, kOutside>{{name, format}};
}
template <auto... kSteps>
consteval auto count_of(std::string_view name, FieldFormat format = {}) {
  return Count<At<kSteps...>>{{name, format}};
}
template <auto... kSteps>
consteval auto nested(std::string_view name, FieldFormat format = {}) {
  return Nested<At<kSteps...>>{{name, format}};
}
consteval auto sent_time(std::string_view name, FieldFormat format = {}) {
  return SentTime{{name, format}};
}
template <class... Places>
consteval auto unpublished() {
  return Unpublished<Places...>{};
}

}  // namespace earshot::messages
