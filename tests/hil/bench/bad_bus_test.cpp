#include "hil/bench/bad_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <set>

#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/seconds.hpp"

namespace earshot::hil {
namespace {

constexpr std::uint32_t kHeadingOfCompass = 0x09F11224;      ///< 127250 = 0x1F112 from 0x24, single frames
constexpr std::uint32_t kHeadingOfAnother = 0x09F11277;      ///< likewise from 0x77
constexpr std::uint32_t kFixOfNavigation = 0x0DF80527;       ///< 129029 = 0x1F805 from 0x27, fast packets
constexpr std::uint32_t kPositionOfNavigation = 0x09F80127;  ///< 129025 = 0x1F801

n2k::Frame frame_of(std::uint32_t identifier, std::uint8_t number = 0) {
  return {identifier, 8, {number, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}};
}

Frames frames_of(std::uint32_t identifier, std::size_t count) {
  Frames frames;
  for (std::size_t i = 0; i < count; ++i) frames.push_back(frame_of(identifier, static_cast<std::uint8_t>(i)));
  return frames;
}

std::vector<Affliction> only(Fault fault, Duration seconds = {}) {
  return {{.fault = fault, .frames = {}, .seconds = seconds}};
}

/// Of one frame, at once.
n2k::Frame spoilt(const n2k::Frame& frame, Fault fault) {
  BadBus bus(1);
  const Frames arriving = bus.pass({frame}, only(fault), Time{});
  EXPECT_EQ(arriving.size(), 1U);
  return arriving.empty() ? n2k::Frame{} : arriving.front();
}

TEST(BadBus, PassesEveryFrameInItsOrderWhenNothingIsWrong) {
  BadBus bus(1);
  const Frames said = frames_of(kHeadingOfCompass, 100);
  EXPECT_EQ(bus.pass(said, {}, Time{}), said);
  EXPECT_EQ(bus.afflicted(), 0U);
}

TEST(BadBus, LosesEveryFrameAndCountsIt) {
  BadBus bus(1);
  EXPECT_TRUE(bus.pass(frames_of(kHeadingOfCompass, 5), only(Fault::kLoss), Time{}).empty());
  EXPECT_EQ(bus.afflicted(), 5U);
  EXPECT_TRUE(bus.pass({}, {}, at_s(1000)).empty());
}

TEST(BadBus, DelaysAFrameBehindWhatIsSaidMeanwhileAndBringsItBeforeWhatIsSaidThen) {
  BadBus bus(1);
  const n2k::Frame a = frame_of(kHeadingOfCompass, 1);
  const n2k::Frame b = frame_of(kHeadingOfCompass, 2);
  const n2k::Frame c = frame_of(kHeadingOfCompass, 3);
  EXPECT_EQ(bus.pass({a}, only(Fault::kDelay, Duration::seconds(2)), at_s(0)), Frames{});
  EXPECT_EQ(bus.pass({b}, {}, at_s(1)), Frames{b});
  EXPECT_EQ(bus.pass({c}, {}, at_s(2)), (Frames{a, c}));
  EXPECT_EQ(bus.pass({}, {}, at_s(3)), Frames{});
}

TEST(BadBus, BringsWhatIsLateInTheOrderInWhichItFallsDue) {
  BadBus bus(1);
  const Frames early = frames_of(kHeadingOfCompass, 3);
  const n2k::Frame later = frame_of(kHeadingOfAnother);
  (void)bus.pass(early, only(Fault::kDelay, Duration::seconds(5)), at_s(0));
  (void)bus.pass({later}, only(Fault::kDelay, Duration::seconds(1)), at_s(1));
  EXPECT_EQ(bus.pass({}, {}, at_s(10)), (Frames{later, early[0], early[1], early[2]}));
}

TEST(BadBus, AddsUpTwoDelays) {
  BadBus bus(1);
  const std::vector<Affliction> both{{.fault = Fault::kDelay, .frames = {}, .seconds = Duration::seconds(2)},
                                     {.fault = Fault::kDelay, .frames = {}, .seconds = Duration::seconds(3)}};
  (void)bus.pass({frame_of(kHeadingOfCompass)}, both, at_s(0));
  EXPECT_TRUE(bus.pass({}, {}, at_s(4)).empty());
  EXPECT_EQ(bus.pass({}, {}, at_s(5)).size(), 1U);
}

TEST(BadBus, ScattersFramesOverTheJitterSoThatTheyOvertakeEachOther) {
  BadBus bus(1);
  EXPECT_TRUE(bus.pass(frames_of(kHeadingOfCompass, 1000), only(Fault::kJitter, Duration::seconds(10)), at_s(0)).empty());
  std::vector<unsigned> numbers;
  for (std::int64_t s = 1; s <= 10; ++s) {
    const Frames arriving = bus.pass({}, {}, at_s(s));
    // A tenth of 1000 in each second; the standard deviation is sqrt(1000 x 0.1 x 0.9) = 9.5.
    EXPECT_NEAR(static_cast<double>(arriving.size()), 100.0, 50.0) << s;
    for (const n2k::Frame& frame : arriving) numbers.push_back(frame.data[0]);
  }
  EXPECT_EQ(numbers.size(), 1000U) << "none is later than that";
  EXPECT_FALSE(std::ranges::is_sorted(numbers));
}

TEST(BadBus, BringsADoubleFrameAtOnceAndTwice) {
  BadBus bus(1);
  const n2k::Frame a = frame_of(kHeadingOfCompass, 1);
  const n2k::Frame b = frame_of(kHeadingOfCompass, 2);
  EXPECT_EQ(bus.pass({a, b}, only(Fault::kDuplication), Time{}), (Frames{a, a, b, b}));
}

TEST(BadBus, FlipsOneBitOfTheDataAndAnyOfThem) {
  BadBus bus(1);
  std::set<unsigned> bits;
  // Of 64 bits each is missed by 2000 frames with a chance of (63/64)^2000 = 2e-14.
  for (const n2k::Frame& frame : bus.pass(Frames(2000, frame_of(kHeadingOfCompass)), only(Fault::kCorruption), Time{})) {
    const n2k::Frame whole = frame_of(kHeadingOfCompass);
    ASSERT_EQ(frame.identifier, whole.identifier);
    ASSERT_EQ(frame.size, whole.size);
    int others = 0;
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned difference = unsigned{frame.data.at(i)} ^ unsigned { whole.data.at(i) };
      others += std::popcount(difference);
      if (difference != 0) bits.insert(8 * i + static_cast<unsigned>(std::countr_zero(difference)));
    }
    ASSERT_EQ(others, 1);
  }
  EXPECT_EQ(bits.size(), 64U);
}

TEST(BadBus, FlipsNoBitBehindTheDataOfAShortFrame) {
  BadBus bus(1);
  n2k::Frame two = frame_of(kHeadingOfCompass);
  two.size = 2;
  for (const n2k::Frame& frame : bus.pass(Frames(200, two), only(Fault::kCorruption), Time{}))
    ASSERT_TRUE(std::equal(frame.data.begin() + 2, frame.data.end(), two.data.begin() + 2));
  n2k::Frame none = two;
  none.size = 0;
  EXPECT_EQ(spoilt(none, Fault::kCorruption), none);
}

TEST(BadBus, SaysNotAvailableInEveryByteThatAFrameHas) {
  n2k::Frame three = frame_of(kHeadingOfCompass);
  three.size = 3;
  EXPECT_EQ(spoilt(three, Fault::kNotAvailable), (n2k::Frame{kHeadingOfCompass, 3, {0xFF, 0xFF, 0xFF, 0x33, 0x44, 0x55, 0x66, 0x77}}));
}

TEST(BadBus, CutsOffTheSecondHalfOfTheData) {
  n2k::Frame frame = frame_of(kHeadingOfCompass);
  EXPECT_EQ(spoilt(frame, Fault::kTruncation).size, 4);
  frame.size = 7;
  EXPECT_EQ(spoilt(frame, Fault::kTruncation).size, 3);
}

TEST(BadBus, SaysAnotherLengthInTheFirstFrameOfAFastPacketAndNothingElse) {
  // The third packet (2 in the upper three bits) and its first frame (0 in the lower five), of 43 bytes.
  const n2k::Frame first{kFixOfNavigation, 8, {0x40, 43, 1, 2, 3, 4, 5, 6}};
  BadBus bus(1);
  std::set<unsigned> lengths;
  for (n2k::Frame frame : bus.pass(Frames(5000, first), only(Fault::kWrongLength), Time{})) {
    lengths.insert(frame.data[1]);
    frame.data[1] = 43;
    ASSERT_EQ(frame, first);
  }
  EXPECT_FALSE(lengths.contains(43));
  EXPECT_EQ(lengths.size(), 255U) << "any other; each is missed with a chance of (254/255)^5000 = 3e-9";
  const n2k::Frame second{kFixOfNavigation, 8, {0x41, 43, 1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(spoilt(second, Fault::kWrongLength), second);
  const n2k::Frame single{kHeadingOfCompass, 8, {0x40, 43, 1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(spoilt(single, Fault::kWrongLength), single) << "its second byte is the heading";
}

TEST(BadBus, CountsNoFrameToWhichAFaultDidNothing) {
  BadBus bus(1);
  (void)bus.pass({frame_of(kHeadingOfCompass)}, only(Fault::kWrongLength), Time{});
  n2k::Frame without_data = frame_of(kHeadingOfCompass);
  without_data.size = 0;
  (void)bus.pass({without_data}, only(Fault::kNotAvailable), Time{});
  EXPECT_EQ(bus.afflicted(), 0U);
  (void)bus.pass({frame_of(kHeadingOfCompass)}, only(Fault::kNotAvailable), Time{});
  EXPECT_EQ(bus.afflicted(), 1U);
}

TEST(BadBus, MakesEveryFaultOfFramesThatACanBusCanHaveAndRefusesTheOthers) {
  for (const FaultTraits& traits : kFaultTraits) {
    BadBus bus(1);
    const bool is_frames = traits.hits == FaultTarget::kFrames && traits.bus != FaultBus::kLcm;
    const auto pass = [&] { (void)bus.pass({frame_of(kFixOfNavigation)}, only(traits.fault, Duration::seconds(1)), Time{}); };
    if (!is_frames) {
      EXPECT_THROW(pass(), NoMaker) << traits.word;
      continue;
    }
    EXPECT_NO_THROW(pass()) << traits.word;
    EXPECT_EQ(bus.afflicted(), 1U) << traits.word;
  }
}

TEST(BadBus, PlaysAFrameBackWordForWordOnce) {
  BadBus bus(1);
  const n2k::Frame a = frame_of(kHeadingOfCompass, 1);
  const n2k::Frame b = frame_of(kHeadingOfCompass, 2);
  EXPECT_EQ(bus.pass({a}, only(Fault::kReplay, Duration::seconds(60)), at_s(0)), Frames{a});
  EXPECT_EQ(bus.pass({}, only(Fault::kReplay, Duration::seconds(60)), at_s(59)), Frames{});
  EXPECT_EQ(bus.pass({b}, {}, at_s(60)), (Frames{a, b}));
  EXPECT_EQ(bus.pass({}, {}, at_s(1000)), Frames{});
}

TEST(BadBus, HitsTheFramesOfOneDeviceAlone) {
  BadBus bus(1);
  const std::vector<Affliction> of_compass{{.fault = Fault::kLoss, .frames = {.source = 0x24, .pgn = {}}, .seconds = {}}};
  const n2k::Frame another = frame_of(kHeadingOfAnother);
  EXPECT_EQ(bus.pass({frame_of(kHeadingOfCompass), another}, of_compass, Time{}), Frames{another});
  EXPECT_EQ(bus.afflicted(), 1U);
}

TEST(BadBus, HitsOneParameterGroupAlone) {
  BadBus bus(1);
  const std::vector<Affliction> of_positions{{.fault = Fault::kLoss, .frames = {.source = {}, .pgn = n2k::kPositionPgn}, .seconds = {}}};
  const n2k::Frame fix = frame_of(kFixOfNavigation);
  EXPECT_EQ(bus.pass({frame_of(kPositionOfNavigation), fix}, of_positions, Time{}), Frames{fix});
}

TEST(BadBus, HitsItsShareOfTheFramesDrawnOneByOne) {
  const auto arriving = [](double share) {
    BadBus bus(1);
    const std::vector<Affliction> loss{{.fault = Fault::kLoss, .frames = {.source = {}, .pgn = {}, .share = share}, .seconds = {}}};
    return static_cast<double>(bus.pass(frames_of(kHeadingOfCompass, 10'000), loss, Time{}).size());
  };
  EXPECT_EQ(arriving(0.0), 10'000.0);
  EXPECT_EQ(arriving(1.0), 0.0);
  // Five standard deviations of sqrt(10000 x 0.8 x 0.2) = 40.
  EXPECT_NEAR(arriving(0.2), 8'000.0, 200.0);
}

TEST(BadBus, LeavesAloneWhatIsNoIdentifier) {
  BadBus bus(1);
  const n2k::Frame frame = frame_of(1U << 29U);
  EXPECT_EQ(bus.pass({frame}, only(Fault::kLoss), Time{}), Frames{frame});
  EXPECT_EQ(bus.afflicted(), 0U);
}

TEST(BadBus, DoesTheSameWithTheSameSeedAndNotWithAnother) {
  const std::vector<Affliction> everything{
      {.fault = Fault::kLoss, .frames = {.source = {}, .pgn = {}, .share = 0.3}, .seconds = {}},
      {.fault = Fault::kJitter, .frames = {.source = {}, .pgn = {}, .share = 0.5}, .seconds = Duration::seconds(3)},
      {.fault = Fault::kCorruption, .frames = {.source = {}, .pgn = {}, .share = 0.2}, .seconds = {}}};
  const auto flight = [&everything](std::uint64_t seed) {
    BadBus bus(seed);
    Frames all;
    for (std::int64_t s = 0; s < 10; ++s) {
      const Frames arriving = bus.pass(frames_of(kHeadingOfCompass, 20), everything, at_s(s));
      all.insert(all.end(), arriving.begin(), arriving.end());
    }
    return all;
  };
  EXPECT_EQ(flight(7), flight(7));
  EXPECT_NE(flight(7), flight(8));
}

}  // namespace
}  // namespace earshot::hil
