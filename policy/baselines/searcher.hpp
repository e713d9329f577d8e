#pragma once

#include <cstddef>

#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/policy/heard.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::baselines {

/// What a searcher knows before it starts; must outlive it.
struct Briefing {
  search::SearchSettings settings;
  search::ActionTable actions;
  const sonar::SnrCurve& snr;  ///< SNR against range as it is expected, which need not be what is heard
};

/// What there is to go by at the start and after every step.
struct Look {
  NorthEast position;  ///< where navigation believes the vehicle, in the domain's frame
  policy::Heard heard;
  NorthEast vehicle;  ///< the truth; for oracles only
  NorthEast source;   ///< the truth: the nearest source; for oracles only
};

/// Anything that searches, learned or not: chooses a step after every look. One object flies many searches, one after the other.
class Searcher {
 public:
  Searcher() = default;
  Searcher(const Searcher&) = delete;
  Searcher& operator=(const Searcher&) = delete;
  virtual ~Searcher() = default;

  /// A new search begins: forgets everything. @param random  for whatever it draws in this search
  virtual void begin(Pcg32 random) = 0;
  /// The next step. Called once for every look, the first at the start. @return an action below the number of actions
  [[nodiscard]] virtual std::size_t choose(const Look& look) = 0;
};

}  // namespace earshot::baselines
