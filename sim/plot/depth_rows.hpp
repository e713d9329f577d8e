#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/sonar/sonar_field.hpp"

namespace earshot::plot {

/// Rows of a picture of a field, equally far apart as a picture must have them; each is the field's row that lies nearest to its depth.
/// The field's depths may lie at any distance from each other: the picture shows each where it is.
struct DepthRows {
  std::vector<double> depth_m;        ///< of the rows' middles
  std::vector<std::size_t> of_field;  ///< the depth of the field that each shows
};

/// From half a spacing above the first depth to half a spacing below the last; from the surface where the first lies no further below it
/// than the second below the first.
///
/// @param depth_m  two or more, increasing
/// @param rows  how many there are to be
/// Oracle: DepthRows.*
[[nodiscard]] DepthRows depth_rows(std::span<const double> depth_m, std::size_t rows);

/// The SNR to draw at a range and one of the rows. Where the field has none since its depth lies below the sea floor, that of the deepest
/// water above: the sea floor is drawn over it, and nothing shows between the two. NaN where there is no water.
/// Oracle: DepthRows.*
[[nodiscard]] float snr_to_draw(const sonar::SonarField& field, std::size_t range, std::size_t depth);

}  // namespace earshot::plot
