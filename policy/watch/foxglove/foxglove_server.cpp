#include "policy/watch/foxglove/foxglove_server.hpp"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "policy/watch/foxglove/viewer.hpp"
#include "policy/watch/http/this_computer.hpp"

namespace earshot::watch {
namespace {

using Json = nlohmann::json;

constexpr const char* kSubprotocol = "foxglove.websocket.v1";
constexpr std::size_t kMostViewers = 16;
constexpr std::size_t kMostIncoming_bytes = 64U << 10U;
constexpr int kClose = -1;  ///< of a callback: the connection ends

/// Sites that may read: Foxglove's own, and viewers that run on this computer.
bool may_read(std::string_view origin) {
  if (origin.empty() || origin == "https://app.foxglove.dev" || origin == "file://") return true;
  for (const std::string_view scheme : {"http://", "https://"})
    if (origin.starts_with(scheme)) return is_this_computer(origin.substr(scheme.size()));
  return false;
}

std::string header_of(lws* connection, lws_token_indexes token) {
  std::string text(static_cast<std::size_t>(std::max(lws_hdr_total_length(connection, token), 0)) + 1, '\0');
  const int size = lws_hdr_copy(connection, text.data(), static_cast<int>(text.size()), token);
  text.resize(static_cast<std::size_t>(std::max(size, 0)));
  return text;
}

/// The protocol's time: nanoseconds since 1970, or since the flight began where its clock has no date.
std::uint64_t nanoseconds_of(Time time) {
  constexpr std::uint64_t kNanosecondsPerMicrosecond = 1000;
  return static_cast<std::uint64_t>(std::max<std::int64_t>(time.us, 0)) * kNanosecondsPerMicrosecond;
}

}  // namespace

/// The server's thread: libwebsockets calls back on it alone, and who publishes wakes it.
class FoxgloveServer::Service {
 public:
  explicit Service(std::uint16_t port);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  void publish(std::span<const journal::TopicMessage> messages);

 private:
  struct Channel {
    const journal::Topic* topic = nullptr;
    std::uint64_t time_ns = 0;
    std::string last;  ///< message
  };

  static int on_event(lws* connection, lws_callback_reasons reason, void* /*session*/, void* in, std::size_t size);
  static int refuse(lws* connection, lws_callback_reasons reason, void* /*session*/, void* /*in*/, std::size_t /*size*/);
  [[nodiscard]] int greet(lws* connection);
  [[nodiscard]] int receive(lws* connection, std::string_view piece);
  [[nodiscard]] int send_to(lws* connection);
  void obey(Viewer& viewer, const Json& request);
  void subscribe(Viewer& viewer, const Json& subscription);
  [[nodiscard]] static Json advertisement_of(std::size_t channel, const journal::Topic& topic);
  [[nodiscard]] std::size_t channel_of(const journal::Topic* topic);

  std::mutex mutex_;  ///< of all below
  std::vector<Channel> channels_;
  std::map<lws*, Viewer> viewers_;
  std::uint64_t time_ns_ = 0;

  std::atomic<bool> is_over_ = false;
  std::uint16_t port_ = 0;
  std::array<lws_protocols, 3> protocols_{{{"http-only", refuse, 0, 0, 0, nullptr, 0},
                                           {kSubprotocol, on_event, 0, kMostIncoming_bytes, 0, nullptr, 0},
                                           {nullptr, nullptr, 0, 0, 0, nullptr, 0}}};
  lws_context* context_ = nullptr;
  std::thread thread_;
};

FoxgloveServer::Service::Service(std::uint16_t port) {
  constexpr unsigned kOthers = 8;       // files of the library itself, and connections that it is about to refuse
  constexpr unsigned kGreeting_s = 10;  // for a connection to say what it wants
  lws_set_log_level(0, nullptr);
  lws_context_creation_info info{};
  info.port = port;
  info.iface = "127.0.0.1";
  info.protocols = protocols_.data();
  info.user = this;
  info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
  info.fd_limit_per_thread = kMostViewers + kOthers;
  info.timeout_secs = kGreeting_s;
  info.server_string = "earshot";
  context_ = lws_create_context(&info);
  lws_vhost* const host = context_ != nullptr ? lws_get_vhost_by_name(context_, "default") : nullptr;
  if (host == nullptr) {
    if (context_ != nullptr) lws_context_destroy(context_);
    throw host::BadInput("--foxglove-port = " + std::to_string(port) + ": another program listens there; 0 takes a free one");
  }
  port_ = static_cast<std::uint16_t>(lws_get_vhost_listen_port(host));
  thread_ = std::thread([this] {
    while (!is_over_) lws_service(context_, 0);
  });
}

FoxgloveServer::Service::~Service() {
  is_over_ = true;
  lws_cancel_service(context_);
  thread_.join();
  lws_context_destroy(context_);
}

void FoxgloveServer::Service::publish(std::span<const journal::TopicMessage> messages) {
  if (messages.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    for (const journal::TopicMessage& message : messages) {
      const std::size_t channel = channel_of(message.topic);
      const std::uint64_t time_ns = nanoseconds_of(message.logged);
      channels_[channel].time_ns = time_ns;
      channels_[channel].last = message.json;
      for (auto& [connection, viewer] : viewers_) viewer.send(static_cast<Viewer::Channel>(channel), time_ns, message.json);
      if (time_ns == time_ns_) continue;
      time_ns_ = time_ns;
      for (auto& [connection, viewer] : viewers_) viewer.send_time(time_ns);
    }
  }
  lws_cancel_service(context_);
}

std::size_t FoxgloveServer::Service::channel_of(const journal::Topic* topic) {
  const auto known = std::ranges::find(channels_, topic, &Channel::topic);
  if (known != channels_.end()) return static_cast<std::size_t>(known - channels_.begin());
  channels_.push_back({.topic = topic, .time_ns = 0, .last = {}});
  const std::size_t channel = channels_.size() - 1;
  for (auto& [connection, viewer] : viewers_)
    viewer.control(Json{{"op", "advertise"}, {"channels", Json::array({advertisement_of(channel, *topic)})}}.dump());
  return channel;
}

Json FoxgloveServer::Service::advertisement_of(std::size_t channel, const journal::Topic& topic) {
  return {{"id", channel},
          {"topic", topic.name},
          {"encoding", "json"},
          {"schemaName", topic.schema_name},
          {"schemaEncoding", "jsonschema"},
          {"schema", topic.schema}};
}

int FoxgloveServer::Service::refuse(lws* connection, lws_callback_reasons reason, void* /*session*/, void* /*in*/, std::size_t /*size*/) {
  if (reason == LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION) return kClose;  // a WebSocket without the protocol's name
  if (reason == LWS_CALLBACK_HTTP) {
    lws_return_http_status(connection, HTTP_STATUS_NOT_FOUND, nullptr);
    return kClose;
  }
  return 0;
}

int FoxgloveServer::Service::on_event(lws* connection, lws_callback_reasons reason, void* /*session*/, void* in, std::size_t size) {
  Service& service = *static_cast<Service*>(lws_context_user(lws_get_context(connection)));
  switch (reason) {
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
      return is_this_computer(header_of(connection, WSI_TOKEN_HOST)) && may_read(header_of(connection, WSI_TOKEN_ORIGIN)) ? 0 : kClose;
    case LWS_CALLBACK_ESTABLISHED:
      return service.greet(connection);
    case LWS_CALLBACK_RECEIVE:
      return service.receive(connection, {static_cast<const char*>(in), size});
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return service.send_to(connection);
    case LWS_CALLBACK_CLOSED: {
      const std::lock_guard lock(service.mutex_);
      service.viewers_.erase(connection);
      return 0;
    }
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      lws_callback_on_writable_all_protocol(lws_get_context(connection), &service.protocols_[1]);
      return 0;
    default:
      return 0;
  }
}

int FoxgloveServer::Service::greet(lws* connection) {
  const std::lock_guard lock(mutex_);
  if (viewers_.size() >= kMostViewers) return kClose;
  Viewer& viewer = viewers_[connection];
  viewer.control(Json{{"op", "serverInfo"}, {"name", "Earshot"}, {"capabilities", {"time"}}, {"metadata", Json::object()}}.dump());
  Json channels = Json::array();
  for (std::size_t i = 0; i < channels_.size(); ++i) channels.push_back(advertisement_of(i, *channels_[i].topic));
  viewer.control(Json{{"op", "advertise"}, {"channels", channels}}.dump());
  viewer.send_time(time_ns_);
  lws_callback_on_writable(connection);
  return 0;
}

int FoxgloveServer::Service::receive(lws* connection, std::string_view piece) {
  const std::lock_guard lock(mutex_);
  Viewer& viewer = viewers_[connection];
  if (viewer.incoming.size() + piece.size() > kMostIncoming_bytes) return kClose;
  viewer.incoming += piece;
  if (lws_is_final_fragment(connection) == 0 || lws_remaining_packet_payload(connection) > 0) return 0;
  const Json request = Json::parse(std::exchange(viewer.incoming, {}), nullptr, false);
  if (request.is_object())
    obey(viewer, request);
  else
    viewer.control(status(2, "a message of the viewer is no JSON object"));
  lws_callback_on_writable(connection);
  return 0;
}

void FoxgloveServer::Service::obey(Viewer& viewer, const Json& request) {
  const auto list_of = [&](const char* key) {
    const auto found = request.find(key);
    return found != request.end() && found->is_array() ? *found : Json::array();
  };
  const Json operation = request.value("op", Json());
  if (operation == "subscribe") {
    for (const Json& one : list_of("subscriptions")) subscribe(viewer, one);
  } else if (operation == "unsubscribe") {
    for (const Json& one : list_of("subscriptionIds"))
      if (!one.is_number_unsigned() || !viewer.unsubscribe(one.get<Viewer::Subscription>()))
        viewer.control(status(1, "there is no subscription " + one.dump()));
  } else {
    viewer.control(status(1, "a viewer may subscribe and unsubscribe; this is refused: " + operation.dump()));
  }
}

void FoxgloveServer::Service::subscribe(Viewer& viewer, const Json& subscription) {
  const auto number_of = [&](const char* key) -> std::optional<std::uint32_t> {
    if (!subscription.is_object()) return std::nullopt;
    const auto found = subscription.find(key);
    if (found == subscription.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::uint32_t>();
  };
  const std::optional<std::uint32_t> id = number_of("id");
  const std::optional<std::uint32_t> number = number_of("channelId");
  if (!id || !number || *number >= channels_.size() || !viewer.subscribe(*id, *number)) {
    viewer.control(status(2, "no such channel, or a subscription that is there already: " + subscription.dump()));
    return;
  }
  const Channel& channel = channels_[*number];
  if (!channel.last.empty()) viewer.send(*number, channel.time_ns, channel.last);
}

int FoxgloveServer::Service::send_to(lws* connection) {
  std::optional<Frame> frame;
  bool is_waiting = false;
  {
    const std::lock_guard lock(mutex_);
    Viewer& viewer = viewers_[connection];
    frame = viewer.next();
    is_waiting = viewer.is_waiting();
  }
  if (!frame) return 0;
  const std::size_t size = frame->bytes.size();
  frame->bytes.insert(0, LWS_PRE, '\0');                                                // where the library writes its own header
  auto* const begin = reinterpret_cast<unsigned char*>(frame->bytes.data()) + LWS_PRE;  // NOLINT: characters are bytes
  if (lws_write(connection, begin, size, frame->is_binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT) < static_cast<int>(size)) return kClose;
  if (is_waiting) lws_callback_on_writable(connection);
  return 0;
}

FoxgloveServer::FoxgloveServer(std::uint16_t port) : service_(std::make_unique<Service>(port)) {}
FoxgloveServer::~FoxgloveServer() = default;

std::uint16_t FoxgloveServer::port() const {
  return service_->port();
}

void FoxgloveServer::publish(std::span<const journal::TopicMessage> messages) {
  service_->publish(messages);
}

}  // namespace earshot::watch
