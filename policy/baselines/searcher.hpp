#pragma once

#include <cstddef>
#include <optional>

#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::baselines {

/// What a searcher knows before it starts; must outlive it.
struct PriorKnowledge {
  search::SearchSettings settings;
  search::ActionTable actions;
  const sonar::SnrCurve& snr;         ///< SNR against range as it is expected, which need not be what is heard
  const policy::OceanTables& oceans;  ///< that are believed possible
};

/// What a searcher decides by, at the start and after every step.
struct DecisionInput {
  NorthEast position;  ///< where navigation believes the vehicle, in the domain's frame
  policy::Reception reception;
  NorthEast vehicle;  ///< the truth; for oracles only
  NorthEast source;   ///< the truth: the nearest source; for oracles only
};

/// Anything that searches, learned or not: chooses a step after every measurement. One object flies many searches, one after the other.
class Searcher {
 public:
  Searcher() = default;
  Searcher(const Searcher&) = delete;
  Searcher& operator=(const Searcher&) = delete;
  virtual ~Searcher() = default;

  /// A new search begins: forgets everything. @param random  for whatever it draws in this search
  virtual void begin(Pcg32 random) = 0;
  /// The next step. Called at the start and after every step. @return an action below the number of actions
  [[nodiscard]] virtual std::size_t choose(const DecisionInput& input) = 0;
  /// What a vehicle goes on to weigh on its way to the next measurement; what it next chooses is the same whether it was called or not.
  virtual void refine() {}
  /// Whether it says that the source is found where it last chose; nothing for one that leaves that to others.
  [[nodiscard]] virtual std::optional<bool> declares_found() const { return std::nullopt; }
  /// Whether what it heard in this search is explained by nothing that it believes possible; absent: it does not judge that.
  [[nodiscard]] virtual std::optional<bool> is_mismatched() const { return std::nullopt; }
};

}  // namespace earshot::baselines
