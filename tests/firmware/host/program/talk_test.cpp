#include "firmware/host/program/talk.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace earshot::program {
namespace {

struct Printed {
  std::string output;
  std::string error;
};

Printed printed_at(Talk how_much) {
  set_talk(how_much);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  print() << "done" << std::flush;
  detail() << "setting" << std::flush;
  set_talk(Talk::kNormal);
  Printed printed;
  printed.output = testing::internal::GetCapturedStdout();
  printed.error = testing::internal::GetCapturedStderr();
  return printed;
}

TEST(Talk, IsWhatWasDoneUnlessAskedForMoreOrLess) {
  const Printed quiet = printed_at(Talk::kQuiet);
  EXPECT_EQ(quiet.output + quiet.error, "");
  const Printed normal = printed_at(Talk::kNormal);
  EXPECT_EQ(normal.output, "done");
  EXPECT_EQ(normal.error, "");
  const Printed verbose = printed_at(Talk::kVerbose);
  EXPECT_EQ(verbose.output, "done");
  EXPECT_EQ(verbose.error, "setting");
}

}  // namespace
}  // namespace earshot::program
