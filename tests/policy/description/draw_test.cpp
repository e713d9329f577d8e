#include "policy/description/draw.hpp"

#include <gtest/gtest.h>

namespace earshot::description {
namespace {

using policy::ActionDraw;

TEST(Draw, IsCalledArgmaxOrSampled) {
  EXPECT_EQ(name_of(ActionDraw::kArgmax), "argmax");
  EXPECT_EQ(name_of(ActionDraw::kSampled), "sampled");
  EXPECT_EQ(draw_named("argmax"), ActionDraw::kArgmax);
  EXPECT_EQ(draw_named("sampled"), ActionDraw::kSampled);
}

TEST(Draw, IsNothingUnderAnotherName) {
  EXPECT_EQ(draw_named("Argmax"), std::nullopt);
  EXPECT_EQ(draw_named(""), std::nullopt);
}

}  // namespace
}  // namespace earshot::description
