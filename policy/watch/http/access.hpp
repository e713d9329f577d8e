#pragma once

#include <optional>
#include <string>

#include "policy/watch/http/password.hpp"

namespace earshot::watch {

/// What decides whether a request is answered. "": that header is not there, or several times.
struct Asked {
  std::string method;
  std::string path;
  std::string host;
  std::string origin;
  std::string fetch_site;     ///< Sec-Fetch-Site
  std::string authorization;  ///< "Basic ..."
  std::string address;        ///< of this computer, that the request came to: "127.0.0.1", "::1"
};

struct Refusal {
  int status = 0;
  std::string why;  ///< a sentence for a person
  bool asks_password = false;
};

inline constexpr const char* kPagePath = "/";
inline constexpr const char* kEventsPath = "/events";

/// Who may read the page and its events.
///
/// A page of somebody else's, in the browser of somebody who may, must not: its name, which it can let stand for this computer's address
/// (DNS rebinding), is not among the hosts, which are the names of loopback and the address that the request came to; and its own
/// requests bear its Origin, or Sec-Fetch-Site.
/// Source: RFC 9110 (methods, Host), RFC 7617 (Basic), Fetch Metadata Request Headers (W3C).
/// Oracle: Access.*
class Access {
 public:
  explicit Access(std::optional<Password> password) : password_(std::move(password)) {}
  /// Nothing: it is answered.
  [[nodiscard]] std::optional<Refusal> refusal_of(const Asked& asked) const;

 private:
  std::optional<Password> password_;
};

}  // namespace earshot::watch
