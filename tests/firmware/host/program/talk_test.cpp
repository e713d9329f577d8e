#include "firmware/host/program/talk.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace earshot::program {
namespace {

struct Said {
  std::string output;
  std::string error;
};

Said said_at(Talk how_much) {
  set_talk(how_much);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  say() << "done" << std::flush;
  detail() << "setting" << std::flush;
  set_talk(Talk::kNormal);
  Said said;
  said.output = testing::internal::GetCapturedStdout();
  said.error = testing::internal::GetCapturedStderr();
  return said;
}

TEST(Talk, IsWhatWasDoneUnlessAskedForMoreOrLess) {
  const Said quiet = said_at(Talk::kQuiet);
  EXPECT_EQ(quiet.output + quiet.error, "");
  const Said normal = said_at(Talk::kNormal);
  EXPECT_EQ(normal.output, "done");
  EXPECT_EQ(normal.error, "");
  const Said verbose = said_at(Talk::kVerbose);
  EXPECT_EQ(verbose.output, "done");
  EXPECT_EQ(verbose.error, "setting");
}

}  // namespace
}  // namespace earshot::program
