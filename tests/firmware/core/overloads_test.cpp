#include "firmware/core/overloads.hpp"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <variant>

namespace earshot {
namespace {

using Value = std::variant<int, char, std::string>;

TEST(Overloads, AreCalledByTheAlternativeThatIsThere) {
  int number = 0;
  std::string text;
  const Overloads take{[&](int value) { number = value; }, [&](const std::string& value) { text = value; }, Unheeded<char>{}};
  std::visit(take, Value{7});
  std::visit(take, Value{'x'});
  std::visit(take, Value{std::string("seven")});
  EXPECT_EQ(number, 7) << "a character is no number";
  EXPECT_EQ(text, "seven");
}

struct TakesInt {
  void operator()(int /*value*/) const {}
};

TEST(Overloads, TakeNothingThatIsNotAmongThem) {
  EXPECT_TRUE((std::is_invocable_v<Overloads<TakesInt, Unheeded<std::string>>, std::string>));
  EXPECT_FALSE((std::is_invocable_v<Overloads<TakesInt, Unheeded<char>>, std::string>));
  EXPECT_FALSE((std::is_invocable_v<Unheeded<int>, char>)) << "nor what could be converted";
}

}  // namespace
}  // namespace earshot
