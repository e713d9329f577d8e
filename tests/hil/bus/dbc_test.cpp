#include "hil/bus/dbc.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "firmware/messages/dictionary/every_message.hpp"

namespace earshot::hil {
namespace {

TEST(Dbc, DescribesVesselHeadingAsTheStandardDoes) {
  std::ostringstream out;
  print_dbc(out);
  const std::string dbc = out.str();
  // 127250 = 0x1F112 at priority 2 from 0x23: 0x09F11223 with DBC's extended bit: 0x89F11223 = 2314277411.
  EXPECT_NE(dbc.find("\nBO_ 2314277411 VesselHeading: 8 Vehicle\n"), std::string::npos);
  EXPECT_NE(dbc.find("\n SG_ Heading : 8|16@1+ (0.0001,0) [0|6.28318530717959] \"rad\" Earshot\n"), std::string::npos);
  EXPECT_NE(dbc.find("\n SG_ Deviation : 24|16@1- "), std::string::npos);
}

/// Some line names the values of a signal of that name, all that there are.
template <class Enum>
void expect_all_named(const std::string& dbc, std::string_view name) {
  const std::string signal(name);
  std::istringstream lines(dbc);
  for (std::string line; std::getline(lines, line);) {
    const bool names_all = std::ranges::all_of(messages::WordsOf<Enum>::kTable, [&line](const messages::Word<Enum>& word) {
      const std::string named = " " + std::to_string(static_cast<int>(word.value)) + " \"" + std::string(word.name) + "\"";
      return line.find(named) != std::string::npos;
    });
    if (line.starts_with("VAL_ ") && line.find(" " + signal + " ") != std::string::npos && names_all) return;
  }
  ADD_FAILURE() << signal << " has a value without a name";
}

TEST(Dbc, NamesEveryValueThatEarshotSends) {
  std::ostringstream out;
  print_dbc(out);
  const std::string dbc = out.str();
  std::size_t enums = 0;
  const auto expect_line_named = [&]<class Line>(const Line& line) {
    if constexpr (requires { typename Line::Value; }) {
      if constexpr (messages::HasWords<typename Line::Value>) {
        if (line.format.bus.key == 0) return;
        expect_all_named<typename Line::Value>(dbc, line.format.bus.name);
        ++enums;
      }
    }
  };
  [&]<class... Messages>(messages::Types<Messages...>) {
    (messages::for_each_line<Messages>(expect_line_named), ...);
  }(messages::EveryMessage{});
  // Order, twice; outcome; state, reason of the end, authority, response.
  EXPECT_EQ(enums, 7U);
}

}  // namespace
}  // namespace earshot::hil
