#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace earshot::watch {

inline constexpr std::size_t kMostHeadBytes = std::size_t{16} << 10U;
inline constexpr std::chrono::seconds kMostHeadTime{5};

/// The beginning of a request, up to its empty line, as whoever interprets it is given it: the request line, and of the headers those that
/// decide about an answer. A Range or a body is none of them.
/// Oracle: RequestHead.*
[[nodiscard]] std::string needed_of_head(std::string_view head);

enum class HeadFault { kTooLarge, kTooSlow, kGone };

struct HeadRead {
  std::string head;                ///< up to and with the empty line
  std::optional<HeadFault> fault;  ///< then it is not whole
};
/// Waits for it, no longer than `most`.
/// @param stop  readable: the server ends, and waits no longer
[[nodiscard]] HeadRead read_head(int socket, int stop, std::chrono::milliseconds most = kMostHeadTime);

}  // namespace earshot::watch
