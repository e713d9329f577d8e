#pragma once

#include "firmware/core/units.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::ocean {

/// The level that the table [noise] of an environment file gives, dB re 1 uPa in its band.
[[nodiscard]] Decibels read_noise(host::TableReader table);

}  // namespace earshot::ocean
