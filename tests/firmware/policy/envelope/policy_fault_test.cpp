#include "firmware/policy/envelope/policy_fault.hpp"

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

/// Every fault, by README.md of the format: what the caller should do, and a word of what a person reads.
TEST(PolicyFault, SaysWhatTheCallerShouldDoAndWhatIsWrong) {
  struct Expected {
    PolicyFault fault;
    Status status;
    std::string_view word;
  };
  for (const auto& [fault, status, word] :
       {Expected{PolicyFault::kNone, Status::kOk, "as it should be"},
        Expected{PolicyFault::kTooShort, Status::kMalformed, "cut short"},
        Expected{PolicyFault::kTooLong, Status::kMalformed, "behind its end"},
        Expected{PolicyFault::kBadMagic, Status::kMalformed, "not a .policy file"},
        Expected{PolicyFault::kUnknownVersion, Status::kUnsupported, "another version"},
        Expected{PolicyFault::kBadChecksum, Status::kCorrupt, "CRC-32 is wrong"},
        Expected{PolicyFault::kUnknownSection, Status::kUnsupported, "a section this program does not know"},
        Expected{PolicyFault::kUnknownSectionVersion, Status::kUnsupported, "of a version this program does not know"},
        Expected{PolicyFault::kMissingSection, Status::kMalformed, "is missing"},
        Expected{PolicyFault::kSectionTwice, Status::kMalformed, "twice"},
        Expected{PolicyFault::kBadSectionLength, Status::kMalformed, "not as long as"},
        Expected{PolicyFault::kBadShape, Status::kMalformed, "a size that is zero"},
        Expected{PolicyFault::kTooLarge, Status::kFull, "larger network"},
        Expected{PolicyFault::kUnknownActivation, Status::kUnsupported, "activation"},
        Expected{PolicyFault::kUnknownFeature, Status::kUnsupported, "feature"},
        Expected{PolicyFault::kUnknownDraw, Status::kUnsupported, "draws"},
        Expected{PolicyFault::kUnknownListening, Status::kUnsupported, "listens"},
        Expected{PolicyFault::kNotFinite, Status::kOutOfRange, "not finite"},
        Expected{PolicyFault::kOutOfRange, Status::kOutOfRange, "out of its range"},
        Expected{PolicyFault::kUnbounded, Status::kOutOfRange, "overflow"},
        Expected{PolicyFault::kNoAdvice, Status::kMalformed, "preference of every action"},
        Expected{PolicyFault::kGoldenMismatch, Status::kCorrupt, "arithmetic differs"}}) {
    EXPECT_EQ(status_of(fault), status) << word;
    EXPECT_NE(to_string(fault).find(word), std::string_view::npos) << to_string(fault);
  }
}

TEST(PolicyFault, IsUnreadableWhereNobodyKnowsIt) {
  EXPECT_EQ(to_string(static_cast<PolicyFault>(255)), "is unreadable");
  EXPECT_EQ(status_of(static_cast<PolicyFault>(255)), Status::kMalformed);
}

}  // namespace
}  // namespace earshot::policy
