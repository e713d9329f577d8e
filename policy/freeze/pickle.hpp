#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace earshot::freeze {

/// The content of a pickle as plain data. Python's unpickler imports and calls what a pickle names; this one only writes the names down.
struct PickleValue {
  enum class Kind : std::uint8_t {
    kNone,
    kBoolean,  ///< integer is 0 or 1
    kInteger,
    kReal,
    kText,
    kTuple,
    kList,
    kDictionary,  ///< items: key, value, key, value
    kGlobal,      ///< text: "module.name"
    kCall,        ///< text: "module.name"; items: its arguments
    kPersistent,  ///< items: the tuple that names an object outside the pickle
  };
  Kind kind = Kind::kNone;
  std::int64_t integer = 0;
  double real = 0.0;
  std::string text = {};
  std::vector<std::size_t> items = {};  ///< places in Pickle::values; a value may hold itself
};

struct Pickle {
  std::vector<PickleValue> values;
  std::size_t root = 0;

  [[nodiscard]] const PickleValue& at(std::size_t place) const { return values[place]; }
  [[nodiscard]] const PickleValue& top() const { return values[root]; }
};

/// The names that a pickle may hold. Any other is refused.
struct PickleRules {
  std::function<bool(std::string_view)> may_name;  ///< "module.name" as a value
  std::function<bool(std::string_view)> may_call;  ///< "module.name" with arguments; only written down
};

inline constexpr std::string_view kOrderedDict = "collections.OrderedDict";  ///< a call of it without arguments reads as a dictionary

/// Reads protocols 2 to 5, of their opcodes those that describe plain data, classes by name, and the calls that `rules` let through.
/// Throws host::BadInput for any other opcode or name, for a name of over 256 characters or a call with over 8 arguments, for texts
/// and items of over 4 MiB in all, and for bytes that are cut short or go on after the end.
[[nodiscard]] Pickle read_pickle(std::string_view bytes, const PickleRules& rules);

}  // namespace earshot::freeze
