#include "policy/watch/http/access.hpp"

#include <string_view>

#include "policy/watch/http/this_computer.hpp"

namespace earshot::watch {
namespace {

constexpr int kUnauthorized = 401;
constexpr int kForbidden = 403;
constexpr int kNotFound = 404;
constexpr int kMethodNotAllowed = 405;
constexpr int kMisdirected = 421;

/// The name in a Host header, whose port a tunnel changes: "[fe80::1]:8020" is fe80::1.
std::string_view name_in(std::string_view host) {
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

bool is_own_host(const Asked& asked) {
  return is_this_computer(asked.host) || (!asked.address.empty() && name_in(asked.host) == asked.address);
}

/// A person who opens the address has no site ("none"), old browsers say nothing.
bool is_of_own_page(const Asked& asked) {
  const bool is_own_origin = asked.origin.empty() || asked.origin == "http://" + asked.host;
  return is_own_origin && (asked.fetch_site.empty() || asked.fetch_site == "same-origin" || asked.fetch_site == "none");
}

}  // namespace

std::optional<Refusal> Access::refusal_of(const Asked& asked) const {
  if (!is_own_host(asked)) return Refusal{kMisdirected, "This computer does not answer to that name: open it by its address."};
  if (asked.method != "GET" && asked.method != "HEAD") return Refusal{kMethodNotAllowed, "Here is only something to read."};
  if (password_ && !password_->is_in(asked.authorization)) return Refusal{kUnauthorized, "The password is missing or wrong.", true};
  if (asked.path == kPagePath) return std::nullopt;
  if (asked.path != kEventsPath) return Refusal{kNotFound, "There is no such page."};
  if (!is_of_own_page(asked)) return Refusal{kForbidden, "Another page may not read this."};
  return std::nullopt;
}

}  // namespace earshot::watch
