#include "policy/evaluate/interval.hpp"

#include <gtest/gtest.h>

namespace earshot::evaluate {
namespace {

/// An interval that is known.
struct Known {
  FoundCount count;
  double low_percent;
  double high_percent;
};

// Of the definition, in Python with 60 digits: p where the sum of C(n, i) p^i (1 - p)^(n - i) over i >= k, or i <= k, is 0.025, by
// bisection. 0 and 10 of 10 also by hand: 0.025^(1/10) = 0.6915. 10 of 100, 4.90 to 17.62 %, stands in printed tables.
constexpr Known kIntervals[] = {{{0, 10}, 0.0, 30.8497},       {{1, 10}, 0.2529, 44.5016},   {{5, 10}, 18.7086, 81.2914},
                                {{10, 10}, 69.1503, 100.0},    {{29, 30}, 82.7831, 99.9156}, {{10, 100}, 4.9005, 17.6223},
                                {{290, 300}, 93.9555, 98.3902}};
constexpr double kDigits = 6e-5;  // half of the last one given

TEST(ExactInterval, GivesTheIntervalsOfClopperAndPearson) {
  for (const Known& p : kIntervals) {
    const Interval i = exact_interval(p.count);
    EXPECT_NEAR(100.0 * i.low, p.low_percent, kDigits) << p.count.found << " of " << p.count.searches;
    EXPECT_NEAR(100.0 * i.high, p.high_percent, kDigits) << p.count.found << " of " << p.count.searches;
  }
}

TEST(ExactInterval, IsNeverCertainOfAllNorOfNone) {
  EXPECT_EQ(exact_interval({10, 10}).high, 1.0);
  EXPECT_NEAR(exact_interval({10, 10}).low, 0.6915, 5e-5);
  EXPECT_EQ(exact_interval({0, 10}).low, 0.0);
  EXPECT_NEAR(exact_interval({0, 10}).high, 0.3085, 5e-5);
  EXPECT_NEAR(exact_interval({1, 1}).low, 0.025, 1e-12);  // the chance of one find in one is p itself
  EXPECT_LT(exact_interval({3'000, 3'000}).low, 1.0);
}

}  // namespace
}  // namespace earshot::evaluate
