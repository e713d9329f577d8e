#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "sim/link/mailbox.hpp"
#include "sim/link/messages.hpp"

namespace earshot::link {

/// DDS could not be set up: the message says which call failed and why.
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr std::uint32_t kLowestDomain = 50;   ///< its UDP ports (7400 + 250 x domain) stand clear of LCM's 7667
inline constexpr std::uint32_t kHighestDomain = 99;  ///< its UDP ports stay below the range that Linux hands out to others (32768)

/// How long a killed process goes unnoticed by the one it leaves behind: less than the 5 s that users are promised, more than a loaded
/// machine (user-mode Linux on one busy core) makes a living process wait for its turn.
inline constexpr int kLeaseSeconds = 3;
static_assert(kLeaseSeconds < 5);

/// Tells one run from all others: whatever a domain carries of another run is not meant for this one. 0: not known yet.
using RunId = std::uint64_t;

/// A number that no other run has; of 63 bits, as all whole numbers of command lines.
[[nodiscard]] RunId new_run();

/// Configuration of Cyclone DDS for one simulation: loopback only, unicast (so that a network namespace with nothing but `lo` will do), no
/// multicast. An observer joins with the same text in CYCLONEDDS_URI.
[[nodiscard]] std::string cyclone_configuration();

/// A participant in one DDS domain and everything it owns. Its sockets receive from the loopback interface only.
class Session {
 public:
  /// Throws LinkError.
  explicit Session(std::uint32_t domain);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] std::int32_t participant() const { return participant_; }

 private:
  void join(std::uint32_t domain);

  std::int32_t domain_ = 0;
  std::int32_t participant_ = 0;
};

}  // namespace earshot::link
