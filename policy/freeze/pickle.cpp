#include "policy/freeze/pickle.hpp"

#include <bit>
#include <iomanip>
#include <map>
#include <sstream>

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;
using Kind = PickleValue::Kind;

constexpr std::size_t kMaxPickleBytes = std::size_t{1024} * 1024;
constexpr std::size_t kMaxHeldBytes = 4 * kMaxPickleBytes;  ///< texts and items: a value recalled again and again is held that often
constexpr std::size_t kMaxNameSize = 256;
constexpr std::size_t kMaxArguments = 8;  ///< of a call; a tensor is rebuilt with 6

/// Opcodes by the names of Python's pickletools.
enum class Opcode : std::uint8_t {
  kMark = '(',
  kStop = '.',
  kNone = 'N',
  kBinInt = 'J',
  kBinInt1 = 'K',
  kBinInt2 = 'M',
  kBinFloat = 'G',
  kBinUnicode = 'X',
  kAppend = 'a',
  kAppends = 'e',
  kBuild = 'b',
  kGlobal = 'c',
  kEmptyDict = '}',
  kEmptyList = ']',
  kEmptyTuple = ')',
  kBinGet = 'h',
  kLongBinGet = 'j',
  kBinPut = 'q',
  kLongBinPut = 'r',
  kReduce = 'R',
  kSetItem = 's',
  kSetItems = 'u',
  kTuple = 't',
  kBinPersId = 'Q',
  kProto = 0x80,
  kTuple1 = 0x85,
  kTuple2 = 0x86,
  kTuple3 = 0x87,
  kNewTrue = 0x88,
  kNewFalse = 0x89,
  kShortBinUnicode = 0x8c,
  kStackGlobal = 0x93,
  kMemoize = 0x94,
  kFrame = 0x95,
};

/// The stack machine of a pickle, on places of values instead of objects. Nothing here recurses, and every opcode adds at most one value.
class Machine {
 public:
  Machine(std::string_view bytes, const PickleRules& rules) : bytes_(bytes), rules_(rules) {}

  Pickle run() {
    if (bytes_.size() > kMaxPickleBytes) throw BadInput("pickle: over 1 MiB");
    for (;;) {
      const std::size_t at = position_;
      const auto opcode = static_cast<Opcode>(little_endian(1));
      if (opcode == Opcode::kStop) break;
      if (!data(opcode) && !container(opcode) && !memory(opcode) && !name(opcode)) refuse(opcode, at);
    }
    pickle_.root = pop();
    if (!stack_.empty() || position_ != bytes_.size()) throw BadInput("pickle: goes on after its end");
    return std::move(pickle_);
  }

 private:
  [[noreturn]] static void refuse(Opcode opcode, std::size_t at) {
    std::ostringstream text;
    text << "pickle: opcode 0x" << std::hex << std::setw(2) << std::setfill('0') << static_cast<int>(opcode) << std::dec << " at byte "
         << at << " is not one that plain weights need";
    throw BadInput(text.str());
  }

  std::string_view take(std::size_t size) {
    if (size > bytes_.size() - position_) throw BadInput("pickle: cut short");
    const std::string_view taken = bytes_.substr(position_, size);
    position_ += size;
    return taken;
  }
  std::uint64_t little_endian(std::size_t size) {
    std::uint64_t value = 0;
    const std::string_view taken = take(size);
    for (std::size_t i = size; i-- > 0;) value = (value << 8U) | static_cast<std::uint8_t>(taken[i]);
    return value;
  }
  /// A text behind its length, a number of at most four bytes.
  std::string_view counted_text(std::size_t bytes_of_length) { return take(static_cast<std::size_t>(little_endian(bytes_of_length))); }
  double big_endian_double() {
    std::uint64_t bits = 0;
    for (const char c : take(8)) bits = (bits << 8U) | static_cast<std::uint8_t>(c);
    return std::bit_cast<double>(bits);
  }
  std::string line() {
    const std::size_t end = bytes_.find('\n', position_);
    if (end == std::string_view::npos) throw BadInput("pickle: cut short");
    const std::string text(take(end - position_));
    ++position_;
    return text;
  }

  void hold(std::size_t text_size, std::size_t item_count) {
    held_bytes_ += text_size + item_count * sizeof(std::size_t);
    if (held_bytes_ > kMaxHeldBytes) throw BadInput("pickle: holds more than 4 MiB of texts and items");
  }
  std::size_t add(PickleValue value) {
    hold(value.text.size(), value.items.size());
    pickle_.values.push_back(std::move(value));
    return pickle_.values.size() - 1;
  }
  void push(PickleValue value) { stack_.push_back(add(std::move(value))); }
  void push_integer(Kind kind, std::int64_t value) { push({.kind = kind, .integer = value}); }
  std::size_t pop() {
    const std::size_t lowest = marks_.empty() ? 0 : marks_.back();
    if (stack_.size() <= lowest) throw BadInput("pickle: takes more values than there are");
    const std::size_t place = stack_.back();
    stack_.pop_back();
    return place;
  }
  std::vector<std::size_t> pop_count(std::size_t count) {
    std::vector<std::size_t> items(count);
    for (std::size_t i = count; i-- > 0;) items[i] = pop();
    return items;
  }
  std::vector<std::size_t> pop_to_mark() {
    if (marks_.empty()) throw BadInput("pickle: takes values up to a mark that is not there");
    const auto first = stack_.begin() + static_cast<std::ptrdiff_t>(marks_.back());
    std::vector<std::size_t> items(first, stack_.end());
    stack_.erase(first, stack_.end());
    marks_.pop_back();
    return items;
  }
  PickleValue& top(Kind kind, const char* what) {
    const std::size_t lowest = marks_.empty() ? 0 : marks_.back();
    if (stack_.size() <= lowest || pickle_.values[stack_.back()].kind != kind) throw BadInput(std::string("pickle: expected ") + what);
    return pickle_.values[stack_.back()];
  }
  const std::string& pop_text() {
    const PickleValue& value = pickle_.values[pop()];
    if (value.kind != Kind::kText) throw BadInput("pickle: expected a text");
    return value.text;
  }

  bool data(Opcode opcode) {
    switch (opcode) {
      case Opcode::kProto:
        if (const std::uint64_t protocol = little_endian(1); protocol < 2 || protocol > 5) throw BadInput("pickle: unknown protocol");
        return true;
      case Opcode::kFrame:
        static_cast<void>(little_endian(8));
        return true;
      case Opcode::kNone:
        return push({}), true;
      case Opcode::kNewTrue:
        return push_integer(Kind::kBoolean, 1), true;
      case Opcode::kNewFalse:
        return push_integer(Kind::kBoolean, 0), true;
      case Opcode::kBinInt:
        return push_integer(Kind::kInteger, static_cast<std::int32_t>(little_endian(4))), true;
      case Opcode::kBinInt1:
        return push_integer(Kind::kInteger, static_cast<std::int64_t>(little_endian(1))), true;
      case Opcode::kBinInt2:
        return push_integer(Kind::kInteger, static_cast<std::int64_t>(little_endian(2))), true;
      case Opcode::kBinFloat:
        return push({.kind = Kind::kReal, .real = big_endian_double()}), true;
      case Opcode::kBinUnicode:
        return push({.kind = Kind::kText, .text = std::string(counted_text(4))}), true;
      case Opcode::kShortBinUnicode:
        return push({.kind = Kind::kText, .text = std::string(counted_text(1))}), true;
      default:
        return false;
    }
  }

  void append(std::vector<std::size_t> items, Kind kind, const char* what) {
    PickleValue& container = top(kind, what);
    hold(0, items.size());
    container.items.insert(container.items.end(), items.begin(), items.end());
  }

  bool container(Opcode opcode) {
    switch (opcode) {
      case Opcode::kMark:
        return marks_.push_back(stack_.size()), true;
      case Opcode::kEmptyTuple:
        return push({.kind = Kind::kTuple}), true;
      case Opcode::kEmptyList:
        return push({.kind = Kind::kList}), true;
      case Opcode::kEmptyDict:
        return push({.kind = Kind::kDictionary}), true;
      case Opcode::kTuple:
        return push({.kind = Kind::kTuple, .items = pop_to_mark()}), true;
      case Opcode::kTuple1:
        return push({.kind = Kind::kTuple, .items = pop_count(1)}), true;
      case Opcode::kTuple2:
        return push({.kind = Kind::kTuple, .items = pop_count(2)}), true;
      case Opcode::kTuple3:
        return push({.kind = Kind::kTuple, .items = pop_count(3)}), true;
      case Opcode::kAppend:
        return append(pop_count(1), Kind::kList, "a list"), true;
      case Opcode::kAppends:
        return append(pop_to_mark(), Kind::kList, "a list"), true;
      case Opcode::kSetItem:
        return append(pop_count(2), Kind::kDictionary, "a dictionary"), true;
      case Opcode::kSetItems: {
        std::vector<std::size_t> items = pop_to_mark();
        if (items.size() % 2 != 0) throw BadInput("pickle: a key without a value");
        return append(std::move(items), Kind::kDictionary, "a dictionary"), true;
      }
      default:
        return false;
    }
  }

  bool memory(Opcode opcode) {
    switch (opcode) {
      case Opcode::kBinPut:
        return put(little_endian(1)), true;
      case Opcode::kLongBinPut:
        return put(little_endian(4)), true;
      case Opcode::kMemoize:
        return put(memo_.size()), true;
      case Opcode::kBinGet:
        return get(little_endian(1)), true;
      case Opcode::kLongBinGet:
        return get(little_endian(4)), true;
      default:
        return false;
    }
  }
  void put(std::uint64_t index) {
    if (stack_.empty()) throw BadInput("pickle: remembers a value that is not there");
    memo_[index] = stack_.back();
  }
  void get(std::uint64_t index) {
    const auto found = memo_.find(index);
    if (found == memo_.end()) throw BadInput("pickle: recalls a value that it never remembered");
    stack_.push_back(found->second);
  }

  bool name(Opcode opcode) {
    switch (opcode) {
      case Opcode::kGlobal: {
        const std::string module = line();
        return push_global(module, line()), true;
      }
      case Opcode::kStackGlobal: {
        const std::string& last = pop_text();
        return push_global(pop_text(), last), true;
      }
      case Opcode::kReduce:
        return call(), true;
      case Opcode::kBuild:  // attributes of the dictionary itself, such as the version notes of a state_dict
        if (pickle_.values[pop()].kind != Kind::kDictionary) throw BadInput("pickle: expected a dictionary");
        static_cast<void>(top(Kind::kDictionary, "a dictionary"));
        return true;
      case Opcode::kBinPersId:
        return push({.kind = Kind::kPersistent, .items = pop_count(1)}), true;
      default:
        return false;
    }
  }
  void push_global(const std::string& module, const std::string& last) {
    if (module.size() + 1 + last.size() > kMaxNameSize) throw BadInput("pickle: a name of more than 256 characters");
    std::string global = module + "." + last;
    if (!rules_.may_name(global)) throw BadInput("pickle: names " + global + ", which plain weights do not need");
    push({.kind = Kind::kGlobal, .text = std::move(global)});
  }
  void call() {
    const PickleValue& arguments = pickle_.values[pop()];
    const PickleValue& callee = pickle_.values[pop()];
    if (callee.kind != Kind::kGlobal || arguments.kind != Kind::kTuple) throw BadInput("pickle: calls what is no function");
    if (!rules_.may_call(callee.text)) throw BadInput("pickle: calls " + callee.text + ", which plain weights do not need");
    if (arguments.items.size() > kMaxArguments) throw BadInput("pickle: calls " + callee.text + " with more than 8 arguments");
    if (callee.text == kOrderedDict && arguments.items.empty()) return push({.kind = Kind::kDictionary});
    push({.kind = Kind::kCall, .text = callee.text, .items = arguments.items});
  }

  std::string_view bytes_;
  const PickleRules& rules_;
  std::size_t position_ = 0;
  Pickle pickle_;
  std::size_t held_bytes_ = 0;
  std::vector<std::size_t> stack_;  // places
  std::vector<std::size_t> marks_;  // heights of the stack
  std::map<std::uint64_t, std::size_t> memo_;
};

}  // namespace

Pickle read_pickle(std::string_view bytes, const PickleRules& rules) {
  return Machine(bytes, rules).run();
}

}  // namespace earshot::freeze
