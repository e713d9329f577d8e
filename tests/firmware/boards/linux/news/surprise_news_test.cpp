// flight_news.cpp: what it tells of a search that does not believe what it hears.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "firmware/boards/linux/news/flight_news.hpp"
#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::board {
namespace {

TEST(SurpriseNews, SaysOnceThatASearchIsSurprisedAndThatItSweeps) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  const host::FileDescriptor out(ends[0]);
  host::FileDescriptor in(ends[1]);
  std::optional<LineWriter> writer(in.number());
  PortSet ports;
  FlightNews news(ports, *writer);
  messages::Health health;
  health.state = messages::MissionState::kSearch;
  const auto tell = [&](int second, float surprise_bits) {
    health.surprise_bits = surprise_bits;
    news.tell(Time{} + Duration::seconds(second), health);
  };
  tell(0, 6.7F);
  tell(20, 6.75F);
  tell(40, 5.0F);
  health.is_sweeping = true;
  tell(60, 12.0F);
  writer.reset();
  in = host::FileDescriptor();
  std::string text(10'000, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(::read(out.number(), text.data(), text.size()), 0)));
  EXPECT_EQ(text,
            "earshotd: 0 s: SEARCH\n"
            "earshotd: 20 s: SEARCH, is surprised: what it hears is unlikely in every ocean of its tables\n"
            "earshotd: 60 s: SEARCH, sweeps the area: what it hears fits no ocean of its tables\n");
}

}  // namespace
}  // namespace earshot::board
