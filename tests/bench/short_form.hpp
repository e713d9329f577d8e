#pragma once

#include <cstdlib>

namespace earshot::bench {

/// Whether a row is run in its short form (`tests/bench/run --short`): once, and little of it, which shows that what it measures happens.
inline bool is_short() {
  return std::getenv("EARSHOT_BENCH_SHORT") != nullptr;
}

/// How much of something a row does.
template <class Amount>
Amount full_or_short(Amount full, Amount in_short) {
  return is_short() ? in_short : full;
}

/// Whether a row is to put what it measures into a state that it is not about (`tests/bench/run --wrong`): it must end with an error then.
inline bool is_wrong_on_purpose() {
  return std::getenv("EARSHOT_BENCH_WRONG") != nullptr;
}

}  // namespace earshot::bench
