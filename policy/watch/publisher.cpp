#include "policy/watch/publisher.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace earshot::watch {
namespace {

/// An event of a stream of them. Source: HTML Living Standard, section 9.2 (server-sent events).
Frame event(const char* name, const nlohmann::ordered_json& value) {
  constexpr auto kReplaces = nlohmann::ordered_json::error_handler_t::replace;  // bytes of a journal that are not UTF-8
  return std::make_shared<const std::string>(std::string("event: ") + name + "\ndata: " + value.dump(-1, ' ', false, kReplaces) + "\n\n");
}

}  // namespace

void Publisher::update(report::GrowingFlight& flight, Change change) {
  if (change == Change::kOther) audience_.restart();
  if (change != Change::kNone) whole_ = nullptr;
  const bool has_followers = audience_.has_followers();
  if (has_followers && change == Change::kMore) {
    const nlohmann::ordered_json changes = flight.changes(sent_);
    if (!changes.empty()) audience_.publish(event("news", changes));
  }
  if (!audience_.asks()) return;
  if (!has_followers) sent_ = flight.all_sent();
  if (!whole_) whole_ = event("flight", flight.whole());
  audience_.give(whole_);
}

}  // namespace earshot::watch
