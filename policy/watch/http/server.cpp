#include "policy/watch/http/server.hpp"

#include <httplib.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>
#include <utility>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/transport/wake_event.hpp"
#include "policy/watch/http/access.hpp"
#include "policy/watch/http/bounded_threads.hpp"
#include "policy/watch/http/connection.hpp"
#include "policy/watch/http/page_policy.hpp"
#include "policy/watch/http/request_head.hpp"

namespace earshot::watch {
namespace {

/// A flood of connections is refused as fast as it comes; what waits longer comes again only after a second.
constexpr int kBacklog = 1024;  ///< connections that wait to be accepted
constexpr std::chrono::milliseconds kAfterWrongPassword{500};

/// In the thread that accepts: all others are busy, and this one must not wait.
thread_local bool is_to_refuse = false;
/// What this thread answers on.
thread_local Connection* answered = nullptr;

/// The request that httplib interprets, and where its answer goes.
class GuardedStream final : public httplib::Stream {
 public:
  GuardedStream(Connection& connection, std::string head) : connection_(connection), head_(std::move(head)) {}

  bool is_readable() const override { return read_ < head_.size(); }
  bool is_writable() const override { return true; }
  ssize_t read(char* into, std::size_t size) override {
    const std::size_t count = head_.copy(into, size, read_);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* bytes, std::size_t size) override { return connection_.send({bytes, size}) ? static_cast<ssize_t>(size) : -1; }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }

 private:
  Connection& connection_;
  std::string head_;
  std::size_t read_ = 0;
};

/// httplib's queue has no end. Here a connection has a thread at once, or is refused.
class GuardedQueue final : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> answer) override {
    if (threads_.begin(answer)) return;
    is_to_refuse = true;
    answer();
    is_to_refuse = false;
  }
  void shutdown() override { threads_.finish(); }

 private:
  BoundedThreads threads_{Server::kMostThreads};
};

std::string short_answer(std::string_view status) {
  return "HTTP/1.1 " + std::string(status) + "\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
}

std::string_view status_of(HeadFault fault) {
  return fault == HeadFault::kTooLarge ? "431 Request Header Fields Too Large" : "408 Request Timeout";
}

/// Two of one kind are none.
std::string header(const httplib::Request& request, const char* name) {
  return request.get_header_value_count(name) == 1 ? request.get_header_value(name) : std::string();
}

Asked asked_by(const httplib::Request& request) {
  return {.method = request.method,
          .path = request.path,
          .host = header(request, "Host"),
          .origin = header(request, "Origin"),
          .fetch_site = header(request, "Sec-Fetch-Site"),
          .authorization = header(request, "Authorization"),
          .address = answered->own_address()};
}

}  // namespace

bool is_address(const std::string& text) {
  addrinfo hints{};
  hints.ai_flags = AI_NUMERICHOST;
  addrinfo* found = nullptr;
  if (::getaddrinfo(text.c_str(), nullptr, &hints, &found) != 0) return false;
  ::freeaddrinfo(found);
  return true;
}

class Server::Http final : private httplib::Server {
 public:
  Http(const ServerSettings& settings, Audience& audience)
      : audience_(audience), access_(settings.password), page_(settings.page), page_policy_(content_security_policy(settings.page)) {
    new_task_queue = [] { return new GuardedQueue; };
    // httplib's own options let a second server have the same port.
    set_socket_options([](socket_t socket) {
      constexpr int kOn = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &kOn, sizeof(kOn));
    });
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response);
      return HandlerResponse::Handled;
    });
  }

  ~Http() override {
    is_stopping_ = true;
    stop_.signal();
    stop();
    if (thread_.joinable()) thread_.join();
  }

  /// @return the port
  int begin(const ServerSettings& settings) {
    errno = 0;
    const int port =
        settings.port != 0 ? (bind_to_port(settings.address, settings.port) ? settings.port : -1) : bind_to_any_port(settings.address);
    if (port <= 0) {
      const int cause = errno;
      const std::string what = settings.address + ", port " + std::to_string(settings.port) + ": " + std::strerror(cause);
      if (cause == EADDRINUSE) throw PortTaken(what + " (--port 0 takes one that is free)");
      throw host::BadInput(what);
    }
    ::listen(svr_sock_, kBacklog);  // httplib's own is 5
    thread_ = std::thread([this] {
      (void)listen_after_bind();
      has_ended_ = true;
    });
    while (!is_running() && !has_ended_) std::this_thread::yield();  // before that httplib cannot be stopped
    return port;
  }

  [[nodiscard]] bool has_failed() const { return has_ended_ && !is_stopping_; }

 private:
  bool process_and_close_socket(socket_t number) override {
    const host::FileDescriptor socket(number);
    Connection connection(number, stop_.file_descriptor());
    if (is_to_refuse) {
      const std::string busy = short_answer("503 Service Unavailable");
      return ::send(number, busy.data(), busy.size(), MSG_DONTWAIT | MSG_NOSIGNAL) > 0;
    }
    HeadRead read = read_head(number, stop_.file_descriptor());
    if (read.fault == HeadFault::kGone) return false;
    bool is_answered = false;
    if (read.fault) {
      is_answered = connection.send(short_answer(status_of(*read.fault)));
    } else {
      GuardedStream stream(connection, needed_of_head(read.head));
      answered = &connection;
      bool is_closed = true;
      is_answered = process_request(stream, true, is_closed, nullptr);
      answered = nullptr;
    }
    connection.close_in_order();
    return is_answered;
  }

  void answer(const httplib::Request& request, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("X-Frame-Options", "DENY");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Cross-Origin-Opener-Policy", "same-origin");
    if (const std::optional<Refusal> refusal = access_.refusal_of(asked_by(request))) return refuse(*refusal, response);
    response.set_header("Content-Security-Policy", page_policy_);
    response.status = kOk;
    if (request.path == kPagePath) {
      response.set_content(page_.data(), page_.size(), "text/html; charset=utf-8");
      return;
    }
    if (request.method == "HEAD") return response.set_header("Content-Type", kEventStream);
    const std::shared_ptr<Browser> browser = audience_.join();
    if (!browser) return refuse({kBusy, "All places for browsers are taken.", false}, response);
    response.set_content_provider(
        kEventStream, [browser, connection = answered](std::size_t, httplib::DataSink&) { return connection->send_next(*browser); });
  }

  void refuse(const Refusal& refusal, httplib::Response& response) {
    if (refusal.asks_password) {
      response.set_header("WWW-Authenticate", "Basic realm=\"Earshot\", charset=\"UTF-8\"");
      pollfd stops{stop_.file_descriptor(), POLLIN, 0};
      (void)::poll(&stops, 1, static_cast<int>(kAfterWrongPassword.count()));
    }
    if (refusal.status == kMethodNotAllowed) response.set_header("Allow", "GET, HEAD");
    response.set_header("Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'");
    response.status = refusal.status;
    response.set_content(refusal.why + "\n", "text/plain; charset=utf-8");
  }

  static constexpr int kOk = 200;
  static constexpr int kMethodNotAllowed = 405;
  static constexpr int kBusy = 503;
  static constexpr const char* kEventStream = "text/event-stream";

  Audience& audience_;
  Access access_;
  std::string_view page_;
  std::string page_policy_;
  host::WakeEvent stop_;
  std::atomic<bool> is_stopping_ = false;
  std::atomic<bool> has_ended_ = false;
  std::thread thread_;
};

Server::Server(const ServerSettings& settings, Audience& audience) : http_(std::make_unique<Http>(settings, audience)) {
  const int port = http_->begin(settings);
  const bool is_everywhere = settings.address == "0.0.0.0" || settings.address == "::";
  const std::string host = is_everywhere ? kLoopback : settings.address;
  url_ = "http://" + (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + std::to_string(port) + "/";
}

Server::~Server() = default;

bool Server::has_failed() const {
  return http_->has_failed();
}

}  // namespace earshot::watch
