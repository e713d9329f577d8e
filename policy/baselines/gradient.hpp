#pragma once

#include <cstddef>

#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

/// Climbs the SNR: goes on while it grows louder; when it grows fainter tries a quarter turn to either side of the way it last grew louder
/// on, then further ones; goes straight on through silence. Turns away from the border.
class GradientClimb : public Searcher {
 public:
  explicit GradientClimb(const PriorKnowledge& prior) : prior_(prior) {}
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  /// The direction `by` actions clockwise of another.
  [[nodiscard]] std::size_t turned(std::size_t from, std::ptrdiff_t by) const;

  const PriorKnowledge& prior_;
  Pcg32 random_{0};
  std::size_t heading_ = 0;
  std::size_t louder_ = 0;  ///< heading on which it last grew louder
  std::size_t turns_ = 0;   ///< since it last grew louder
  bool is_first_ = true;
  policy::Reception before_;
};

}  // namespace earshot::baselines
