#include "policy/watch/http/this_computer.hpp"

#include <algorithm>
#include <array>

namespace earshot::watch {

bool is_this_computer(std::string_view host) {
  static constexpr std::array<std::string_view, 3> kNames{"localhost", "127.0.0.1", "[::1]"};
  return std::ranges::any_of(kNames, [&](std::string_view name) {
    if (!host.starts_with(name)) return false;
    const std::string_view port = host.substr(name.size());
    return port.empty() || (port.size() > 1 && port.front() == ':' && port.find_first_not_of("0123456789", 1) == std::string_view::npos);
  });
}

}  // namespace earshot::watch
