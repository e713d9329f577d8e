#include "policy/watch/foxglove/viewer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace earshot::watch {
namespace {

constexpr char kMessageData = 0x01;
constexpr char kTime = 0x02;

template <class Integer>
void append_little_endian(std::string& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    bytes.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8U * i) & 0xFFU));
}

}  // namespace

void Viewer::send(Channel channel, std::uint64_t time_ns, std::string_view message) {
  const auto subscribed = subscriptions_.find(channel);
  if (subscribed == subscriptions_.end()) return;
  std::string bytes(1, kMessageData);
  append_little_endian(bytes, subscribed->second);
  append_little_endian(bytes, time_ns);
  bytes += message;
  queue(std::move(bytes));
}

void Viewer::send_time(std::uint64_t time_ns) {
  std::string bytes(1, kTime);
  append_little_endian(bytes, time_ns);
  queue(std::move(bytes));
}

void Viewer::queue(std::string bytes) {
  waiting_bytes_ += bytes.size();
  messages_.push_back(std::move(bytes));
  for (; waiting_bytes_ > kMostWaiting_bytes; ++dropped_) {
    waiting_bytes_ -= messages_.front().size();
    messages_.pop_front();
  }
}

std::optional<Frame> Viewer::next() {
  if (dropped_ > 0)
    control(status(
        1, std::to_string(std::exchange(dropped_, 0)) + " messages were left out, the oldest that waited: this viewer reads too slowly"));
  if (!controls_.empty()) {
    Frame frame = std::move(controls_.front());
    controls_.pop_front();
    return frame;
  }
  if (messages_.empty()) return std::nullopt;
  Frame frame{.is_binary = true, .bytes = std::move(messages_.front())};
  messages_.pop_front();
  waiting_bytes_ -= frame.bytes.size();
  return frame;
}

bool Viewer::subscribe(Subscription subscription, Channel channel) {
  const bool is_taken = std::ranges::any_of(subscriptions_, [&](const auto& one) { return one.second == subscription; });
  return !is_taken && subscriptions_.emplace(channel, subscription).second;
}

bool Viewer::unsubscribe(Subscription subscription) {
  return std::erase_if(subscriptions_, [&](const auto& one) { return one.second == subscription; }) > 0;
}

std::string status(int level, std::string_view message) {
  return nlohmann::json{{"op", "status"}, {"level", level}, {"message", message}}.dump();
}

}  // namespace earshot::watch
