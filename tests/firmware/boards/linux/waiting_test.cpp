#include "firmware/boards/linux/waiting.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class WaitForTest : public testing::Test {
 protected:
  ~WaitForTest() override {
    program::stop_requested = false;
    program::set_talk(program::Talk::kNormal);
  }

  /// @param calls_until_it_comes  0: never
  Waited wait(seconds limit, int calls_until_it_comes, milliseconds each = milliseconds(0)) {
    testing::internal::CaptureStderr();
    const Waited waited = wait_for("earshotd", "a simulator", limit, [&](milliseconds) {
      std::this_thread::sleep_for(each);
      return ++calls_ == calls_until_it_comes;
    });
    output_ = testing::internal::GetCapturedStderr();
    return waited;
  }

  int calls_ = 0;
  std::string output_;
};

TEST_F(WaitForTest, SaysNothingOfWhoComesAtOnce) {
  EXPECT_EQ(wait(seconds(5), 3), Waited::kCame);
  EXPECT_EQ(calls_, 3);
  EXPECT_EQ(output_, "");
}

TEST_F(WaitForTest, SaysThatItWasInVain) {
  EXPECT_EQ(wait(seconds(0), 0), Waited::kInVain);
  EXPECT_TRUE(support::lines_tell(output_, {{"earshotd", "not", "within 0 s"}}));
}

TEST_F(WaitForTest, EndsWhenItIsToldToStopAndNobodyHasCome) {
  program::stop_requested = true;
  EXPECT_EQ(wait(seconds(5), 0), Waited::kStopped);
  EXPECT_EQ(wait(seconds(5), 2), Waited::kCame) << "who has come is not sent away";
  EXPECT_EQ(output_, "");
}

TEST_F(WaitForTest, SaysOnceForWhomAndHowLongWhenItTakesMoreThanASecond) {
  EXPECT_EQ(wait(seconds(60), 3, milliseconds(1001)), Waited::kCame);
  EXPECT_TRUE(support::lines_tell(output_, {{"earshotd", "60 s", "at most"}}));
}

}  // namespace
}  // namespace earshot::board
