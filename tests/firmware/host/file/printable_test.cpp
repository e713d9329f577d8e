#include "firmware/host/file/printable.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::host {
namespace {

TEST(IsUtf8, TakesWordsOfAnyLanguageAndNoOtherBytes) {
  for (const char* text : {"", "a\tb\n",
                           "Gr\xC3\xB6\xC3\x9F"
                           "e",
                           "\xF0\x9F\x90\x8B"})
    EXPECT_TRUE(is_utf8(text)) << text;
  for (const char* text : {"\xff", "a\xC3", "\xC0\x9B", "\xED\xA0\x80", "\xF4\x90\x80\x80"}) EXPECT_FALSE(is_utf8(text));
}

TEST(Printable, LeavesWordsOfAnyLanguageAsTheyAre) {
  // The last four: the first character of three bytes, the first beyond the surrogates, the first of four bytes, the last there is.
  for (const char* text : {"", "depth_m = 30", "Größe", "鯨", "\xF0\x9F\x90\x8B", "a\\x1b", "/tmp/a b.toml", "\xE0\xA0\x80", "\xEE\x80\x80",
                           "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, SpellsOutControlCharacters) {
  EXPECT_EQ(printable("\x1b[31m"), "\\x1b[31m");
  EXPECT_EQ(printable("a\rb\bc\x07\x7f"), "a\\x0db\\x08c\\x07\\x7f");
  EXPECT_EQ(printable("one\ntwo\tthree"), "one\\ntwo\\tthree");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Printable, SpellsOutControlCharactersOfTwoBytes) {
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u009b31m");                       // CSI in one character
  EXPECT_EQ(printable("\xC2\x80"), "\\u0080");   // the first of them
  EXPECT_EQ(printable("\xC2\xA0"), "\xC2\xA0");  // a space that is not broken steers nothing
}

TEST(Printable, SpellsOutMarksThatTurnTheDirectionOfWriting) {
  EXPECT_EQ(printable("a\xE2\x80\xAE"
                      "b"),
            "a\\u202eb");
  EXPECT_EQ(printable("\xE2\x80\x8F"), "\\u200f");
  EXPECT_EQ(printable("\xE2\x80\x90"), "\xE2\x80\x90");  // a hyphen steers nothing
  EXPECT_EQ(printable("\xE2\x81\xA6"), "\\u2066");
  EXPECT_EQ(printable("\xE2\x81\xA9"), "\\u2069");
  EXPECT_EQ(printable("\xE2\x81\xAA"), "\xE2\x81\xAA");  // the next steers nothing
}

TEST(Printable, SpellsOutBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");
  EXPECT_EQ(printable("\xC0\x9B"), "\\xc0\\x9b");                    // a control character in more bytes than it needs
  EXPECT_EQ(printable("\xE0\x82\x9B"), "\\xe0\\x82\\x9b");           // the same in three
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80");           // half a surrogate pair
  EXPECT_EQ(printable("\xED\xBF\xBF"), "\\xed\\xbf\\xbf");           // the last of them
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond the last character
  EXPECT_EQ(printable("a\xE2\x80"), "a\\xe2\\x80");                  // cut short
}

TEST(Printable, KeepsLinesWhereTheyAreAskedFor) {
  EXPECT_EQ(printable_lines("a\x1b\n\nb\n"), "a\\x1b\n\nb\n");
}

TEST(SpelledApart, MakesBlanksOfAllUnderscores) {
  EXPECT_EQ(spelled_apart("left_the_area"), "left the area");
  EXPECT_EQ(spelled_apart("found"), "found");
}

TEST(Shortened, LeavesOutOfTheMiddleWhatIsTooMuch) {
  EXPECT_EQ(shortened("123456789", 9), "123456789");
  EXPECT_EQ(shortened("1234567890", 9), "123456... (1 more bytes) ...890");
}

// Of two-byte characters, so that either cut would fall into one.
TEST(Shortened, CutsNoCharacter) {
  EXPECT_EQ(shortened("aéééééééé", 9), "aéé... (10 more bytes) ...é");
}

}  // namespace
}  // namespace earshot::host
