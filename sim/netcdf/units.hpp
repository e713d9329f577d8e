#pragma once

namespace earshot::netcdf {

/// Of a level in dB: a tenth of the common logarithm of a ratio of powers. The CF conventions (1.8, section 3.1) take units from UDUNITS,
/// which knows no "dB". What the ratio refers to stands in the variable's `long_name`.
inline constexpr const char* kDecibels = "0.1 lg(re 1)";

}  // namespace earshot::netcdf
