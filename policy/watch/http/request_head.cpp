#include "policy/watch/http/request_head.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>

namespace earshot::watch {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kHeadEnd = "\r\n\r\n";

bool is_needed(std::string_view name) {
  constexpr std::array<std::string_view, 4> kNeeded{"host", "origin", "sec-fetch-site", "authorization"};
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(kNeeded, lower) != kNeeded.end();
}

}  // namespace

std::string needed_of_head(std::string_view head) {
  std::string needed;
  for (bool is_first = true; !head.empty(); is_first = false) {
    const std::string_view line = head.substr(0, head.find(kLineEnd));
    head.remove_prefix(std::min(head.size(), line.size() + kLineEnd.size()));
    if (line.empty()) break;
    if (is_first || is_needed(line.substr(0, line.find(':')))) needed.append(line).append(kLineEnd);
  }
  return needed.append(kLineEnd);
}

HeadRead read_head(int socket, int stop, std::chrono::milliseconds most) {
  using std::chrono::steady_clock;
  const auto deadline = steady_clock::now() + most;
  HeadRead read;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now());
    std::array<pollfd, 2> waits{pollfd{socket, POLLIN, 0}, pollfd{stop, POLLIN, 0}};
    const int ready = left.count() <= 0 ? 0 : ::poll(waits.data(), waits.size(), static_cast<int>(left.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 || waits[1].revents != 0) break;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::recv(socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) return {.head = {}, .fault = HeadFault::kGone};
    const std::size_t seen = read.head.size();
    read.head.append(bytes.data(), static_cast<std::size_t>(count));
    const std::size_t end = read.head.find(kHeadEnd, seen - std::min(seen, kHeadEnd.size() - 1));
    if (end != std::string::npos && end + kHeadEnd.size() <= kMostHeadBytes) {
      read.head.resize(end + kHeadEnd.size());
      return read;
    }
    if (read.head.size() > kMostHeadBytes) return {.head = {}, .fault = HeadFault::kTooLarge};
  }
  return {.head = {}, .fault = HeadFault::kTooSlow};
}

}  // namespace earshot::watch
