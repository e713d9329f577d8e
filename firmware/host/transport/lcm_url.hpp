#pragma once

#include <cstdint>
#include <string_view>

namespace earshot::host {

/// Where LCM messages travel: "udpm://GROUP:PORT?ttl=N&recv_buf_size=N", as stock LCM spells it.
struct LcmUrl {
  std::uint32_t group = 0;  ///< IPv4 multicast address, host byte order
  std::uint16_t port = 0;
  int ttl = 0;                   ///< 0: stays on this host, over the loopback interface only
  int receive_buffer_bytes = 0;  ///< of the kernel; 0: as much as it gives, up to 4 MiB
};

inline constexpr std::string_view kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

/// @throws std::invalid_argument saying which part is wrong and what is allowed; the text names neither file nor key.
[[nodiscard]] LcmUrl parse_lcm_url(std::string_view url);

}  // namespace earshot::host
