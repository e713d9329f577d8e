#pragma once

#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::n2k {

/// A frame off the bus with what its identifier says, read once for all who are given the frame. Refers to the frame, which must outlive
/// it.
struct HeardFrame {
  /// Not explicit: who has one reader gives it the frame as it came.
  HeardFrame(const Frame& heard) : frame(heard), identifier(parse_identifier(heard.identifier)) {}  // NOLINT(google-explicit-constructor)

  const Frame& frame;
  Result<Identifier> identifier;  ///< fails as parse_identifier() does
};

}  // namespace earshot::n2k
