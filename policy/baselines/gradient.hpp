#pragma once

#include <cstddef>

#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

/// Climbs the SNR: goes on while it grows louder, turns when it grows fainter, alternately to either side and further each time; goes
/// straight on through silence. Turns away from the border.
class GradientClimb : public Searcher {
 public:
  explicit GradientClimb(const Briefing& briefing) : briefing_(briefing) {}
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const Look& look) override;

 private:
  [[nodiscard]] std::size_t turned(std::ptrdiff_t by) const;

  const Briefing& briefing_;
  Pcg32 random_{0};
  std::size_t heading_ = 0;
  std::size_t turns_ = 0;  ///< since it last grew louder
  bool is_first_ = true;
  policy::Heard before_;
};

}  // namespace earshot::baselines
