#include "firmware/policy/envelope/policy_fault.hpp"

namespace earshot::policy {

Status status_of(PolicyFault fault) {
  switch (fault) {
    case PolicyFault::kNone:
      return Status::kOk;
    case PolicyFault::kTooShort:
    case PolicyFault::kTooLong:
    case PolicyFault::kBadMagic:
    case PolicyFault::kMissingSection:
    case PolicyFault::kSectionTwice:
    case PolicyFault::kBadSectionLength:
    case PolicyFault::kBadShape:
    case PolicyFault::kNoAdvice:
      return Status::kMalformed;
    case PolicyFault::kTooLarge:
      return Status::kFull;
    case PolicyFault::kUnknownVersion:
    case PolicyFault::kUnknownSection:
    case PolicyFault::kUnknownSectionVersion:
    case PolicyFault::kUnknownActivation:
    case PolicyFault::kUnknownFeature:
    case PolicyFault::kUnknownDraw:
    case PolicyFault::kUnknownListening:
      return Status::kUnsupported;
    case PolicyFault::kBadChecksum:
    case PolicyFault::kGoldenMismatch:
      return Status::kCorrupt;
    case PolicyFault::kNotFinite:
    case PolicyFault::kOutOfRange:
    case PolicyFault::kUnbounded:
      return Status::kOutOfRange;
  }
  return Status::kMalformed;
}

std::string_view to_string(PolicyFault fault) {
  switch (fault) {
    case PolicyFault::kNone:
      return "is as it should be";
    case PolicyFault::kTooShort:
      return "is cut short";
    case PolicyFault::kTooLong:
      return "has bytes behind its end";
    case PolicyFault::kBadMagic:
      return "is not a .policy file";
    case PolicyFault::kUnknownVersion:
      return "is of another version of the .policy format than this program's";
    case PolicyFault::kBadChecksum:
      return "is damaged: its CRC-32 is wrong";
    case PolicyFault::kUnknownSection:
      return "is a section this program does not know";
    case PolicyFault::kUnknownSectionVersion:
      return "is of a version this program does not know";
    case PolicyFault::kMissingSection:
      return "is missing, or not in its place";
    case PolicyFault::kSectionTwice:
      return "stands there twice";
    case PolicyFault::kBadSectionLength:
      return "is not as long as what it holds";
    case PolicyFault::kBadShape:
      return "has a size that is zero, contradicts another or exceeds what this program holds";
    case PolicyFault::kTooLarge:
      return "has a larger network than this program holds";
    case PolicyFault::kUnknownActivation:
      return "has an activation this program does not know";
    case PolicyFault::kUnknownFeature:
      return "observes a feature this program does not know";
    case PolicyFault::kUnknownDraw:
      return "draws its actions in a way this program does not know";
    case PolicyFault::kUnknownListening:
      return "listens in a way this program does not know";
    case PolicyFault::kNotFinite:
      return "holds a weight, scale, direction or place that is not finite, or none";
    case PolicyFault::kOutOfRange:
      return "holds a number that is out of its range";
    case PolicyFault::kUnbounded:
      return "holds scales or weights so large that its logits could overflow";
    case PolicyFault::kNoAdvice:
      return "does not show the preference of every action, by which a policy without a network goes";
    case PolicyFault::kGoldenMismatch:
      return "does not repeat its golden trajectories with this program on this machine: the arithmetic differs, or another version of "
             "Earshot froze it (earshot freeze freezes it again)";
  }
  return "is unreadable";
}

}  // namespace earshot::policy
