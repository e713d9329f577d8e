#include "firmware/policy/check/policy_fault.hpp"

#include <gtest/gtest.h>

#include <set>

namespace earshot::policy {
namespace {

constexpr auto kLast = static_cast<int>(PolicyFault::kGoldenMismatch);

TEST(PolicyFault, HasWordsOfItsOwnForEveryFault) {
  std::set<std::string_view> words;
  for (int fault = 0; fault <= kLast; ++fault) words.insert(to_string(static_cast<PolicyFault>(fault)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(kLast) + 1);
  EXPECT_FALSE(words.contains(to_string(static_cast<PolicyFault>(kLast + 1))));
}

TEST(PolicyFault, IsOkForNoneAlone) {
  EXPECT_EQ(status_of(PolicyFault::kNone), Status::kOk);
  for (int fault = 1; fault <= kLast; ++fault) EXPECT_NE(status_of(static_cast<PolicyFault>(fault)), Status::kOk) << fault;
}

TEST(PolicyFault, SaysWhatTheCallerShouldDo) {
  EXPECT_EQ(status_of(PolicyFault::kTooShort), Status::kMalformed);
  EXPECT_EQ(status_of(PolicyFault::kUnknownSection), Status::kUnsupported);
  EXPECT_EQ(status_of(PolicyFault::kGoldenMismatch), Status::kCorrupt);
  EXPECT_EQ(status_of(PolicyFault::kUnbounded), Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::policy
