#include "firmware/host/definitions/lcm_text.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <vector>

#include "firmware/detector/hydrophone/settings_fields.hpp"
#include "firmware/messages/dictionary/every_message.hpp"
#include "firmware/messages/dictionary/sound_fields.hpp"
#include "firmware/wire/lcm/codec.hpp"

namespace earshot::definitions {
namespace {

using messages::Described;
using messages::FieldFormat;
using messages::NumberField;

std::string in_capitals(std::string_view key) {
  std::string text(key);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string comment(std::string_view text) {
  std::string lines = "// ";
  for (const char c : text) lines += c == '\n' ? "\n// " : std::string(1, c);
  return lines + "\n";
}

/// A declaration and what it means.
struct Declaration {
  std::string text;
  std::string_view meaning;
  std::string_view heading;  ///< a line of its own before it
};

std::string declared(const NumberField& field) {
  std::string text = std::string(wire::lcm_name(field.type)) + " " + std::string(field.name);
  for (const std::size_t size : field.sizes) {
    if (size > 0) text += "[" + std::to_string(size) + "]";
  }
  return text + (field.counted_by.empty() ? "" : "[" + std::string(field.counted_by) + "]") + ";";
}

/// One message's text in the making.
class Definition {
 public:
  template <class Message>
  [[nodiscard]] std::string of() {
    messages::for_each_line<Message>([this](const auto& line) { this->note_taken(line); });
    messages::for_each_line<Message>([this](const auto& line) { this->add_values(line); });
    messages::for_each_line<Message>([this](const auto& line) { this->add(line); });
    using About = Described<Message>;
    const std::string type(About::kType);
    std::string text = comment("Generated: earshot lcm " + type + " > firmware/wire/lcm/" + type +
                               ".lcm. Do not edit: change firmware/messages/dictionary.") +
                       "package earshot;\n\n" + comment(About::kMeaning) + comment("Channel " + std::string(About::kChannel) + ".") +
                       "struct " + type + " {\n";
    print(values_, text);
    if (!values_.empty()) text += "\n";
    print(declarations_, text);
    return text + "}\n";
  }

 private:
  static void print(const std::vector<Declaration>& declarations, std::string& text) {
    std::size_t width = 0;
    for (const Declaration& declaration : declarations) width = std::max(width, declaration.text.size());
    for (const Declaration& declaration : declarations) {
      if (!declaration.heading.empty()) text += "  " + comment(declaration.heading);
      text += "  " + declaration.text;
      if (!declaration.meaning.empty())
        text += std::string(width - declaration.text.size() + 2, ' ') + "// " + std::string(declaration.meaning);
      text += "\n";
    }
  }

  template <class Line>
  void note_taken(const Line& line) {
    if constexpr (requires { typename Line::Value; }) {
      if constexpr (messages::HasWords<typename Line::Value>) {
        if (line.format.values != FieldFormat::Values::kPlain) return;
        for (const auto& word : messages::WordsOf<typename Line::Value>::kTable) taken_.insert(word.key);
      }
    }
  }

  template <class Line>
  void add_values(const Line& line) {
    if constexpr (requires { typename Line::Value; }) {
      if constexpr (messages::HasWords<typename Line::Value>) {
        if (line.format.values == FieldFormat::Values::kNone) return;
        for (const auto& word : messages::WordsOf<typename Line::Value>::kTable) {
          const bool is_prefixed = line.format.values == FieldFormat::Values::kPrefixed ||
                                   (line.format.values == FieldFormat::Values::kPrefixedIfTaken && taken_.contains(word.key));
          const std::string name = (is_prefixed ? in_capitals(line.name) + "_" : "") + in_capitals(word.key);
          values_.push_back({"const int8_t " + name + " = " + std::to_string(static_cast<int>(word.value)) + ";",
                             in_capitals(word.words) == in_capitals(word.key) ? std::string_view() : word.words,
                             {}});
        }
      }
    }
  }

  template <class Line>
  void add(const Line& line) {
    if constexpr (requires { line.numbers(); }) {
      std::string_view heading = line.format.heading;
      for (const NumberField& number : line.numbers()) {
        declarations_.push_back({declared(number), line.format.meaning, heading});
        heading = {};
      }
    } else {
      declarations_.push_back(
          {std::string(Described<typename Line::Element>::kType) + " " + std::string(line.name) + "[" + std::to_string(Line::kSize) + "];",
           line.format.meaning, line.format.heading});
    }
  }

  std::vector<Declaration> values_;
  std::vector<Declaration> declarations_;
  std::set<std::string_view> taken_;  ///< keys of values that stand as they are
};

template <class... Messages>
std::vector<LcmDefinition> definitions_of(messages::Types<Messages...> /*all*/) {
  std::vector<LcmDefinition> all{{Described<Messages>::kType, Definition().of<Messages>()}...};
  std::ranges::sort(all, {}, &LcmDefinition::type);
  return all;
}

}  // namespace

std::vector<LcmDefinition> lcm_definitions() {
  std::vector<LcmDefinition> all = definitions_of(messages::EveryMessage{});
  std::ranges::move(definitions_of(messages::Types<messages::HydrophoneBlock, detector::SoundSettings>{}), std::back_inserter(all));
  return all;
}

}  // namespace earshot::definitions
