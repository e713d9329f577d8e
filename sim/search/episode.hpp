#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/observation.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::search {

/// How an episode stands after a step.
enum class EpisodeEnd : std::uint8_t {
  kRunning,
  kFound,       ///< within l of the source: terminated
  kLeftDomain,  ///< beyond the edge: terminated
  kTimeLimit,   ///< N steps taken: truncated, not terminated
};

/// What an episode came to so far.
struct EpisodeRecord {
  double reward = 0.0;  ///< undiscounted sum
  std::uint32_t steps = 0;
  std::uint32_t detections = 0;  ///< steps that ended with SNR >= DT; the start does not count
  EpisodeEnd end = EpisodeEnd::kRunning;
};

/// What never changes while episodes run; must outlive them.
struct SearchWorld {
  SearchSettings settings;
  const sonar::SnrCurve& snr;  ///< SNR at the vehicle's depth against horizontal range; covers the domain's diagonal
  ActionTable actions;

  SearchWorld(const SearchSettings& s, const sonar::SnrCurve& curve)
      : settings(s), snr(curve), actions(compass_directions(s.direction_count)) {}
};

/// One search: a vehicle that takes steps of length l until it is within l of the source, out of the domain, or out of time.
/// A source reached with step N counts as found.
class Episode {
 public:
  /// Draws the source (kChanging) and the start. A start within l of the source would end before its first step: the start is drawn
  /// again; a changing source is drawn again with it, so that no source position is without a start.
  /// @param model  what is remembered and seen; must outlive the episode
  void start(const SearchWorld& world, const policy::ObservationModel& model, Pcg32& random);
  /// Starts at a given place.
  void start_at(const SearchWorld& world, const policy::ObservationModel& model, NorthEast position, NorthEast source);

  /// Takes one step; returns its reward. @param action below the size of world.actions; the episode is running.
  double step(const SearchWorld& world, std::size_t action);

  /// @param observation  [model.spec.size()]
  void observe(std::span<float> observation) const { policy::observe(memory_, *model_, observation); }

  [[nodiscard]] const EpisodeRecord& record() const { return record_; }
  [[nodiscard]] NorthEast position() const { return position_; }
  [[nodiscard]] NorthEast source() const { return source_; }
  [[nodiscard]] Decibels snr() const { return snr_; }
  /// What is believed about the source; meaningful only when the model's spec needs it.
  [[nodiscard]] const policy::Belief& belief() const { return memory_.belief(); }

 private:
  NorthEast position_;
  NorthEast source_;
  Decibels snr_;
  const policy::ObservationModel* model_ = nullptr;
  policy::SearchMemory memory_;
  EpisodeRecord record_;
};

}  // namespace earshot::search
