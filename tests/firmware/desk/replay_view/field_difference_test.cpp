#include "firmware/desk/replay_view/field_difference.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::replay_view {
namespace {

std::vector<FieldDifference> between(const messages::Health& then, const messages::Health& now, Time then_at = {}, Time now_at = {}) {
  return field_differences(wire::kHealthChannel, wire::Encoded(then, then_at).bytes(), wire::Encoded(now, now_at).bytes());
}

TEST(FieldDifference, NamesEveryFieldWithBothValues) {
  messages::Health then;
  then.state = messages::MissionState::kSearch;
  static_cast<void>(then.ports.push_back({.port = 1, .link_up = true}));
  messages::Health now = then;
  now.state = messages::MissionState::kAbort;
  now.ports[0].lost = 7;
  EXPECT_TRUE(between(then, then).empty());
  const std::vector<FieldDifference> differences = between(then, now);
  const std::vector<FieldDifference> expected{{.field = "state", .then = "\"SEARCH\"", .now = "\"ABORT\""},
                                              {.field = "ports[0].lost", .then = "0", .now = "7"}};
  EXPECT_EQ(differences, expected);
  EXPECT_TRUE(support::tells(to_string(differences), {"SEARCH", "ABORT", "now", "ports[0].lost", "0", "7", "now"}));
}

TEST(FieldDifference, SaysTheByteWhereNoFieldShowsIt) {
  // The date stands behind the fingerprint (8 bytes), big-endian: its last byte is number 15.
  const std::vector<FieldDifference> expected{{.field = "byte 15 of its message", .then = "3", .now = "4"}};
  EXPECT_EQ(between({}, {}, Time{3}, Time{4}), expected);
  const std::vector<std::uint8_t> one{1};
  const std::vector<FieldDifference> shorter{{.field = "its length", .then = "1 byte", .now = "0 bytes"}};
  EXPECT_EQ(field_differences("UNKNOWN", one, {}), shorter);
}

TEST(FieldDifference, TellsFourFieldsAndCountsTheRest) {
  const std::vector<FieldDifference> six(6, {.field = "a", .then = "1", .now = "2"});
  EXPECT_TRUE(to_string(six).ends_with("; and 2 fields more")) << to_string(six);
}

}  // namespace
}  // namespace earshot::replay_view
