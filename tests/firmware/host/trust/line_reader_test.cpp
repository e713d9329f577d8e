#include "firmware/host/trust/line_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

std::string complaint_about(const std::string& text) {
  return complaint_of([&] {
    LineReader reader(text, "a.sig");
    reader.title("title 1");
    (void)reader.number("number");
    std::array<std::uint8_t, 2> bytes{};
    reader.bytes("bytes", bytes);
    reader.end();
  });
}

TEST(LineReader, ReadsWhatStandsInTheOneOrder) {
  LineReader reader("title 1\nnumber 18446744073709551615\nbytes 0aFF\n", "a.sig");
  reader.title("title 1");
  EXPECT_EQ(reader.number("number"), 18'446'744'073'709'551'615U);
  std::array<std::uint8_t, 2> bytes{};
  reader.bytes("bytes", bytes);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 2>{0x0a, 0xff}));
  reader.end();
}

TEST(LineReader, NamesTheFirstLineThatIsWrongAndWhatItMustBe) {
  EXPECT_EQ(complaint_about(""), "a.sig:1: must be \"title 1\"");
  EXPECT_EQ(complaint_about("title 12\n"), "a.sig:1: must be \"title 1\"");
  EXPECT_EQ(complaint_about("title 1"), "a.sig:1: must be \"title 1\"");
  for (const std::string number : {"", "number", "number ", "number -1", "number 07", "number 1 ", "number 18446744073709551616",
                                   "numbers 1", "number  1", "number 0x1", "number 1\r"})
    EXPECT_TRUE(support::tells(complaint_about("title 1\n" + number + "\nbytes 0aff\n"), {"a.sig:2", "number"})) << number;
  for (const std::string bytes :
       {"bytes 0af\n", "bytes 0aff0\n", "bytes 0aff00\n", "bytes 0axf\n", "bytes 0a ff\n", "bytes 0aff", "byte 0aff\n"})
    EXPECT_TRUE(support::tells(complaint_about("title 1\nnumber 1\n" + bytes), {"a.sig:3", "bytes", "4 hexadecimal"})) << bytes;
  EXPECT_EQ(complaint_about("title 1\nnumber 1\nbytes 0aff\n\n"), "a.sig:4: must be the end of the file");
}

}  // namespace
}  // namespace earshot::host
