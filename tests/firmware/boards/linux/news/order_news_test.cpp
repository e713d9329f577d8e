// flight_news.cpp: what it tells of orders that were not as they should be.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "firmware/boards/linux/news/flight_news.hpp"
#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::board {
namespace {

class OrderNews : public testing::Test {
 protected:
  void SetUp() override {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    out_ = host::FileDescriptor(ends[0]);
    in_ = host::FileDescriptor(ends[1]);
    writer_.emplace(in_.number());
    news_.emplace(ports_, *writer_);
  }
  void turn(int at_s) { news_->tell(Time{} + Duration::seconds(at_s), messages::Health{}); }
  std::string told() {
    news_.reset();
    writer_.reset();
    in_ = host::FileDescriptor();
    std::string text(10'000, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(::read(out_.number(), text.data(), text.size()), 0)));
    return text;
  }

  std::optional<FlightNews> news_;

 private:
  host::FileDescriptor out_;
  host::FileDescriptor in_;
  PortSet ports_;
  std::optional<LineWriter> writer_;
};

TEST_F(OrderNews, TellsOfUnreadableOrdersOnceInTenSecondsWithTheirNumberAndTheRemedy) {
  turn(0);
  news_->tell(1, OrderTrouble::kUnreadable);
  turn(1);
  for (int second = 2; second < 11; ++second) {
    for (int i = 0; i < 5; ++i) news_->tell(1, OrderTrouble::kUnreadable);
    turn(second);
  }
  turn(11);
  turn(12);
  const std::string text = told();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 2) << text;  // STANDBY, and two of orders
  EXPECT_NE(text.find("an order could not be read, and was not obeyed"), std::string::npos) << text;
  EXPECT_NE(text.find("mark = bytes(16)"), std::string::npos) << text;
  EXPECT_NE(text.find("; 45 such since it was last told of\n"), std::string::npos) << text;
}

TEST_F(OrderNews, TellsEachTroubleOfEachPortApart) {
  news_->tell(1, OrderTrouble::kCutAbort);
  news_->tell(1, OrderTrouble::kOldMark);
  news_->tell(2, OrderTrouble::kCutAbort);
  turn(0);
  const std::string text = told();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 3) << text;
  EXPECT_NE(text.find("an ABORT was obeyed whose bytes do not fit"), std::string::npos) << text;
}

TEST_F(OrderNews, HasRoomForTheWordsOfEveryTrouble) {
  for (std::size_t i = 0; i < kOrderTroubleCount; ++i) {
    const std::string_view words = to_string(static_cast<OrderTrouble>(i));
    EXPECT_FALSE(words.empty()) << i;
    // A date, a port's name and the count take 150 characters.
    EXPECT_LT(words.size() + 150, LineWriter::kLineBytes) << words;
  }
}

}  // namespace
}  // namespace earshot::board
