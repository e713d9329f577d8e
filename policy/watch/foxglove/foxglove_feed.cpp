#include "policy/watch/foxglove/foxglove_feed.hpp"

#include <variant>

namespace earshot::watch {
namespace {

bool begins_flight(const journal::Entry& entry) {
  const auto* const record = std::get_if<journal::Record>(&entry);
  return record != nullptr && record->number == 0;
}

}  // namespace

void FoxgloveFeed::take(const journal::Entry& entry) {
  if (begins_flight(entry)) timeline_ = {};
  server_.publish(messages_.of(entry, timeline_.take(entry)));
}

std::string FoxgloveFeed::url() const {
  return "ws://127.0.0.1:" + std::to_string(server_.port());
}

}  // namespace earshot::watch
