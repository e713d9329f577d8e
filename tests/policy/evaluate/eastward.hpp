#pragma once

#include <cstddef>
#include <vector>

#include "policy/baselines/searcher.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::evaluate {

/// Goes east, always.
class GoesEast : public baselines::Searcher {
 public:
  void begin(Pcg32) override {}
  std::size_t choose(const baselines::DecisionInput&) override { return 2; }
};

inline const sonar::SnrCurve kHeardNowhere{Meters{1'000.0}, std::vector<float>(40, -30.0F)};

/// Starts 3 km from the east edge, far from a source in the west: lost after four steps, of which the last two end in the border.
inline search::SearchSettings lost_in_the_east() {
  search::SearchSettings settings;
  settings.start_region = {{Meters{12'000.0}, Meters{22'000.0}}, {Meters{12'000.0}, Meters{22'000.0}}};
  settings.source = {Meters{12'000.0}, Meters{2'000.0}};
  return settings;
}

}  // namespace earshot::evaluate
