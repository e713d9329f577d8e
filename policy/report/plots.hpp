#pragma once

#include <string>

#include "policy/report/flight_files.hpp"

namespace earshot::report {

// Pictures as SVG text to stand in a page, drawn by gnuplot. @throws std::runtime_error when gnuplot fails.

/// The SNR field at the vehicle's depth, the track over it, decisions, detections, start and source.
[[nodiscard]] std::string map_svg(const Flight& flight);

/// SNR and range to the source against time, with the detection threshold.
[[nodiscard]] std::string history_svg(const Flight& flight);

}  // namespace earshot::report
