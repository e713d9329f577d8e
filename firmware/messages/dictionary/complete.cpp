#include "firmware/messages/dictionary/enumerators.hpp"
#include "firmware/messages/dictionary/every_message.hpp"
#include "firmware/messages/dictionary/sound_fields.hpp"
#include "firmware/messages/input.hpp"

namespace earshot::messages {

// An enum's new value does not compile before it has its words.
static_assert(has_all_words<MissionState>());
static_assert(has_all_words<EndReason>());
static_assert(has_all_words<Authority>());
static_assert(has_all_words<Order>());
static_assert(has_all_words<CommandOutcome>());
static_assert(has_all_words<config::Response>());
static_assert(has_all_words<config::Condition>());
static_assert(has_all_words<Ending>());
static_assert(has_all_words<ControllerState>());
static_assert(has_all_words<BoardEvent>());
static_assert(kMissionStates == WordsOf<MissionState>::kTable.size());

/// Nor does a member of a message before it has its line.
template <class Message>
struct IsComplete {
  static_assert(covers_all_members<Message>(), "a member of this message has no line in its list (firmware/messages/dictionary)");
  static constexpr bool kIs = true;
};
template <class... Messages>
consteval bool are_complete(Types<Messages...> /*all*/) {
  return (IsComplete<Messages>::kIs && ...);
}
static_assert(are_complete(EveryMessage{}) && are_complete(Types<HydrophoneBlock>{}));
// Those of what a mission's list has in arrays.
static_assert(member_count<config::Rule>() == 5 && member_count<config::Fence>() == 3);

/// All that goes into a runtime is told.
template <class... Values>
consteval bool are_described(std::variant<Values...>* /*values*/) {
  return (IsDescribed<Values> && ...);
}
static_assert(are_described(static_cast<decltype(Input::value)*>(nullptr)));

}  // namespace earshot::messages
