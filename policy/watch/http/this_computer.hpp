#pragma once

#include <string_view>

namespace earshot::watch {

/// Whether a Host header, or an origin behind its scheme, names this computer by a name that no other can take: "localhost:8020",
/// "127.0.0.1", "[::1]:80". A site that makes its own name point here (DNS rebinding) does not pass.
[[nodiscard]] bool is_this_computer(std::string_view host);

}  // namespace earshot::watch
