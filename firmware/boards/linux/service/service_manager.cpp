#include "firmware/boards/linux/service/service_manager.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/words/event_words.hpp"
#include "firmware/host/text/text_line.hpp"

namespace earshot::board {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::optional<std::uint64_t> number_in(const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// A name in the file system, or with a leading @ an abstract one. @return its length; 0: it is none
socklen_t address_of(const std::string& name, sockaddr_un& address) {
  const bool is_name = !name.empty() && (name[0] == '/' || name[0] == '@') && name.size() > 1 && name.size() < sizeof address.sun_path;
  if (!is_name) return 0;
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.sun_path);
  if (name[0] == '@') address.sun_path[0] = '\0';
  const std::size_t end = name[0] == '@' ? 0 : 1;  // of an abstract name every byte counts
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + end);
}

}  // namespace

ServiceEnvironment ServiceEnvironment::of_this_process() {
  ServiceEnvironment environment{.socket = variable("NOTIFY_SOCKET")};
  const std::optional<std::uint64_t> us = number_in(variable("WATCHDOG_USEC"));
  const std::string process = variable("WATCHDOG_PID");
  const bool is_ours = process.empty() || number_in(process) == static_cast<std::uint64_t>(::getpid());
  if (us && *us > 0 && is_ours) environment.watchdog = std::chrono::microseconds(*us);
  return environment;
}

ServiceManager::ServiceManager(const ServiceEnvironment& environment) {
  if (environment.socket.empty()) return;
  const char* why = nullptr;
  sockaddr_un address{};
  if (const socklen_t size = address_of(environment.socket, address); size == 0) {
    why = "neither an absolute path nor @NAME of less than 108 bytes";
  } else {
    socket_ = host::FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const bool is_open = socket_.number() >= 0 && ::connect(socket_.number(), reinterpret_cast<const sockaddr*>(&address), size) == 0;
    if (!is_open) why = std::strerror(errno);
  }
  if (why == nullptr) {
    if (environment.watchdog) between_meals_ = *environment.watchdog / 4;
    return;
  }
  socket_ = {};
  complaint_ = "NOTIFY_SOCKET=" + host::printable(environment.socket) + ": " + why + ": the service manager is given nothing";
}

void ServiceManager::notify(std::string_view message) const {
  if (socket_.number() < 0) return;
  (void)::send(socket_.number(), message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL);  // where it cannot be told nobody listens
}

void ServiceManager::notify_state(const messages::Health& health) const {
  host::TextLine message;
  message << (is_ready_ ? "" : "READY=1\n") << "STATUS=";
  journal::write_standing(message, health.state, health.end_reason, health.steps_taken, journal::AbortedBy::kOperator);
  notify(message.text());
}

void ServiceManager::note_turn(const messages::Health& health, SteadyClock::time_point now) {
  if (!is_ready_ || state_ != health.state || steps_taken_ != health.steps_taken) notify_state(health);
  is_ready_ = true;
  state_ = health.state;
  steps_taken_ = health.steps_taken;
  const bool beats = health.turn != turn_ || health.end_reason == messages::EndReason::kMemoryFault;
  turn_ = health.turn;
  if (!between_meals_ || !beats || (fed_ && now - *fed_ < *between_meals_)) return;
  fed_ = now;
  notify("WATCHDOG=1");
}

void ServiceManager::note_stop() {
  if (std::exchange(is_stopping_, true)) return;
  notify("STOPPING=1");
}

void ServiceManager::ask_for(std::chrono::seconds more) {
  if (is_ready_) return;
  host::TextLine message;
  message << "EXTEND_TIMEOUT_USEC=" << std::chrono::microseconds(more).count();
  notify(message.text());
}

}  // namespace earshot::board
