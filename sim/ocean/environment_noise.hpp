#pragma once

#include "firmware/config_file/table_reader.hpp"
#include "firmware/core/units.hpp"

namespace earshot::ocean {

/// The level that the table [noise] of an environment file gives, dB re 1 uPa in its band.
[[nodiscard]] Decibels read_noise(config_file::TableReader table);

}  // namespace earshot::ocean
