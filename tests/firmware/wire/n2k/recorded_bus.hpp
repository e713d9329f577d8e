#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware/wire/n2k/frame.hpp"

namespace earshot::n2k {

/// One message recorded on a real bus, with what canboat reads in it.
struct Recorded {
  std::uint32_t pgn = 0;
  std::vector<Frame> frames;
  unsigned priority = 0;
  unsigned source = 0;
  unsigned destination = 0;
  std::map<std::string, std::optional<double>> fields;  ///< by our name; empty: not available
};

/// tests/reference/n2k/frames.txt
std::vector<Recorded> recorded_bus();

}  // namespace earshot::n2k
