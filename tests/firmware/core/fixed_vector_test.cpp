#include "firmware/core/fixed_vector.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot {
namespace {

TEST(FixedVector, RefusesWhatDoesNotFitAndKeepsTheRest) {
  FixedVector<int, 2> vector;
  EXPECT_EQ(vector.push_back(1), Status::kOk);
  EXPECT_EQ(vector.push_back(2), Status::kOk);
  EXPECT_EQ(vector.push_back(3), Status::kFull);
  EXPECT_EQ(std::vector(vector.begin(), vector.end()), (std::vector{1, 2}));
}

TEST(FixedVector, TakesNewElementsAfterClear) {
  FixedVector<int, 1> vector;
  EXPECT_EQ(vector.push_back(1), Status::kOk);
  vector.clear();
  EXPECT_TRUE(vector.empty());
  EXPECT_EQ(vector.push_back(2), Status::kOk);
  EXPECT_EQ(vector[0], 2);
}

TEST(FixedVector, SpanCoversOnlyTheElementsThere) {
  FixedVector<int, 8> vector;
  EXPECT_EQ(vector.push_back(5), Status::kOk);
  EXPECT_EQ(vector.span().size(), 1U);
  EXPECT_EQ(vector.capacity(), 8U);
}

}  // namespace
}  // namespace earshot
