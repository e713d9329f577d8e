#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/enumerators.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"

namespace earshot::messages {

// An enum's new value does not compile before it has its words.
static_assert(has_all_words<MissionState>());
static_assert(has_all_words<EndReason>());
static_assert(has_all_words<Authority>());
static_assert(has_all_words<Order>());
static_assert(has_all_words<CommandOutcome>());
static_assert(has_all_words<config::Response>());
static_assert(has_all_words<config::Condition>());
static_assert(kMissionStates == WordsOf<MissionState>::kTable.size());

}  // namespace earshot::messages
