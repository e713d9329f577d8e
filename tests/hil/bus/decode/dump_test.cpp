#include "hil/bus/decode/dump.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace earshot::hil {
namespace {

/// Groups and senders of what is printed of two messages from each of two devices.
std::string shown(const Shown& what) {
  std::ostringstream out;
  const auto printer = printer_of(Format::kCsv, Times::kAsLogged);
  Dump dump(what, *printer, out, nullptr);
  for (const std::uint32_t identifier : {0x09F11201U, 0x09F11901U, 0x09F11202U, 0x09F11902U}) {
    EXPECT_TRUE(dump.take({.time = Time{}, .interface = "c", .frame = n2k::Frame{.identifier = identifier, .size = 0}}));
  }
  std::istringstream lines(out.str());
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(",SID,") == std::string::npos && line.find(",data,") == std::string::npos) continue;
    all += line.substr(11, 1) + ':' + line.substr(19, 6) + ' ';
  }
  return all;
}

TEST(Dump, ShowsTheGroupsAndTheSenderThatAreAskedFor) {
  EXPECT_EQ(shown({}), "1:127250 1:127257 2:127250 2:127257 ");
  EXPECT_EQ(shown({.pgns = {127257, 1}, .source = std::nullopt}), "1:127257 2:127257 ");
  EXPECT_EQ(shown({.pgns = {}, .source = 2}), "2:127250 2:127257 ");
  EXPECT_EQ(shown({.pgns = {127250}, .source = 2}), "2:127250 ");
}

TEST(Dump, CountsTheMessagesThatItPrinted) {
  std::ostringstream out;
  const auto printer = printer_of(Format::kCsv, Times::kAsLogged);
  Dump dump({.pgns = {127257}, .source = std::nullopt}, *printer, out, nullptr);
  for (const std::uint32_t identifier : {0x09F11201U, 0x09F11901U, 0x09F11202U, 0x09F11902U})
    EXPECT_TRUE(dump.take({.time = Time{}, .interface = "c", .frame = n2k::Frame{.identifier = identifier, .size = 0}}));
  EXPECT_EQ(dump.printed(), 2U);
  EXPECT_EQ(dump.counters().frames, 4U);
}

}  // namespace
}  // namespace earshot::hil
