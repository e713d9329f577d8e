#include "firmware/host/transport/lcm_url.hpp"

#include <arpa/inet.h>

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>

namespace earshot::host {

namespace {

constexpr std::string_view kScheme = "udpm://";

[[noreturn]] void refuse(std::string_view what, std::string_view found, std::string_view allowed) {
  throw std::invalid_argument("LCM " + std::string(what) + " \"" + std::string(found) + "\": must be " + std::string(allowed));
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

int number_in(std::string_view what, std::string_view text, int lowest, int highest) {
  const std::optional<int> value = whole_number(text);
  if (!value || *value < lowest || *value > highest) {
    refuse(what, text, "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return *value;
}

/// What stands in `text` before the first `separator`; `text` keeps what stands after it.
std::string_view cut(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view before = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
  return before;
}

void read_option(std::string_view option, LcmUrl& url) {
  std::string_view value = option;
  const std::string_view name = cut(value, '=');
  if (name == "ttl") {
    url.ttl = number_in("ttl", value, 0, 255);
  } else if (name == "recv_buf_size") {
    url.receive_buffer_bytes = number_in("recv_buf_size", value, 1024, 1'000'000'000);
  } else {
    refuse("option", option, "ttl=N or recv_buf_size=N");
  }
}

}  // namespace

LcmUrl parse_lcm_url(std::string_view text) {
  if (!text.starts_with(kScheme)) refuse("URL", text, "udpm://GROUP:PORT?ttl=N");
  std::string_view options = text.substr(kScheme.size());
  std::string_view port = cut(options, '?');
  const std::string group(cut(port, ':'));

  LcmUrl url;
  in_addr address{};
  if (inet_pton(AF_INET, group.c_str(), &address) != 1 || !IN_MULTICAST(ntohl(address.s_addr))) {
    refuse("group", group, "an IPv4 multicast address, 224.0.0.0 to 239.255.255.255");
  }
  url.group = ntohl(address.s_addr);
  url.port = static_cast<std::uint16_t>(number_in("port", port, 1, 65'535));
  while (!options.empty()) read_option(cut(options, '&'), url);
  return url;
}

}  // namespace earshot::host
