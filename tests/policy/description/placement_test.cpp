#include "policy/description/placement.hpp"

#include <gtest/gtest.h>

namespace earshot::description {
namespace {

using search::SourcePlacement;

TEST(Placement, IsReadFromItsOwnLineOfTheProvenance) {
  EXPECT_EQ(placement_in("command = earshot-train --source changing\nsource = fixed\nseed = 1\n"), SourcePlacement::kFixed);
  EXPECT_EQ(placement_in("state = memory\nsource = changing"), SourcePlacement::kChanging);
}

TEST(Placement, IsNotGuessedWhereTheProvenanceDoesNotSay) {
  EXPECT_EQ(placement_in(""), std::nullopt);
  EXPECT_EQ(placement_in("command = earshot-train --source fixed\nresource = fixed\n"), std::nullopt);
  EXPECT_EQ(placement_in("source = drifting\n"), std::nullopt);
}

}  // namespace
}  // namespace earshot::description
