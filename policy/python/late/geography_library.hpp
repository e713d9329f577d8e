#pragma once

#include <cstddef>

/// sim/ocean/charts/geography.hpp in plain numbers: what _geography.so gives, a library of its own that alone is linked with GeographicLib.
/// Angles are degrees but for azimuths, which are radians; lengths are metres.
extern "C" {
void earshot_to_plane(const double* origin_deg, const double* position_deg, double* north_east_m);
void earshot_to_geographic(const double* origin_deg, const double* north_east_m, double* position_deg);
void earshot_geodesic(const double* from_deg, const double* to_deg, double* range_m, double* azimuth_rad);
void earshot_radial(const double* from_deg, double azimuth_rad, const double* range_m, std::size_t count,
                    double* latitudes_and_longitudes_deg);
}
