#pragma once

#include "firmware/wire/n2k/frame.hpp"

namespace earshot::hil {

/// A magnetic heading of 2.3152 rad, from address 0x23: what every recorder of the tests has heard.
inline constexpr n2k::Frame kHeading{.identifier = 0x09F11223, .size = 8, .data = {0xFF, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};

}  // namespace earshot::hil
