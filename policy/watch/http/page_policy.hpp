#pragma once

#include <string>
#include <string_view>

namespace earshot::watch {

/// The Content-Security-Policy of a page in one file: its own scripts run, which are named by their checksums, and nothing is loaded from
/// or sent to anywhere but its server.
/// Source: Content Security Policy Level 3 (W3C).   Oracle: PagePolicy.*
[[nodiscard]] std::string content_security_policy(std::string_view page);

}  // namespace earshot::watch
