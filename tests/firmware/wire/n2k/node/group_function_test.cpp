#include "firmware/wire/n2k/node/group_function.hpp"

#include <gtest/gtest.h>

namespace earshot::n2k {
namespace {

TEST(GroupRefusal, SaysThatAGroupIsNotSupportedUnlessItIsKnown) {
  // To 0x23 from 0x40: sequence 2, frame 0; 6 bytes: acknowledges (2) 126992 = 0x01F010; error; no parameters.
  Frame frame;
  const GroupDemand demand{.function = GroupFunction::kRequest, .pgn = 126'992};
  ASSERT_EQ(compose_group_refusal({.demand = demand, .asker = 0x23}, 0x40, 2, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x0DED2340, 8, {0x40, 6, 2, 0x10, 0xF0, 0x01, 1, 0}}));
  ASSERT_EQ(compose_group_refusal({.demand = demand, .is_known = true, .asker = 0x23}, 0x40, 2, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x0DED2340, 8, {0x40, 6, 2, 0x10, 0xF0, 0x01, 4, 0}}));
}

TEST(GroupRefusal, IsNotMadeOfANumberThatNoGroupHas) {
  Frame frame;
  EXPECT_EQ(compose_group_refusal({.demand = {.pgn = 0xFFFFFF}}, 0x40, 0, frame), Status::kOutOfRange);
  EXPECT_EQ(frame, Frame{});
}

TEST(GroupDemand, IsReadFromSixBytesOn) {
  Frame frame{0x0DED4023, 8, {0xA0, 6, 1, 0x10, 0xF0, 0x01, 0, 0}};
  ASSERT_TRUE(read_group_demand(frame));
  EXPECT_EQ(read_group_demand(frame)->function, GroupFunction::kCommand);
  EXPECT_EQ(read_group_demand(frame)->pgn, 126'992U);
  frame.data[1] = 5;
  EXPECT_FALSE(read_group_demand(frame));
}

}  // namespace
}  // namespace earshot::n2k
