#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/observation.hpp"
#include "sim/search/scenario/surroundings.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::search {

/// How an episode stands after a step.
enum class EpisodeEnd : std::uint8_t {
  kRunning,
  kFound,       ///< within l of the source: terminated
  kLeftDomain,  ///< beyond the edge: terminated
  kTimeLimit,   ///< N steps taken: truncated, not terminated
};

/// The score of an episode so far.
struct EpisodeRecord {
  double reward = 0.0;  ///< undiscounted sum
  std::uint32_t steps = 0;
  std::uint32_t detections = 0;  ///< steps that ended with SNR >= DT; the start does not count
  EpisodeEnd end = EpisodeEnd::kRunning;
};

/// One search: a vehicle that takes steps of length l until it is within l of the source, out of the domain, or out of time.
/// A source reached with step N counts as found.
///
/// In a world with conditions, truth and belief part: reward, border and finding go by where the vehicle is, observations by where
/// navigation believes it, and a detection is one of what was heard. Everything is judged at the ends of steps, as in the paper. What is
/// heard on the way counts as far as SearchSettings::listening reaches; at the start there is one measurement.
class Episode {
 public:
  /// Draws the source (kChanging) and the start. A start within l of the source would end before its first step: the start is drawn
  /// again; a changing source is drawn again with it, so that no source position is without a start. Start and source are those of a calm
  /// world for the same `random`.
  /// @param model   what is remembered and seen; must outlive the episode
  /// @param tables  by which a belief searches; must outlive the episode
  void start(const World& world, const policy::ObservationModel& model, const policy::OceanTables& tables, Pcg32& random);
  /// Starts at a given place. @param conditions  for what the world's conditions draw
  void start_at(const World& world, const policy::ObservationModel& model, const policy::OceanTables& tables, NorthEast position,
                NorthEast source, Pcg32 conditions = Pcg32(0));

  /// Takes one step; returns its reward. @param action below the size of world.actions; the episode is running.
  double step(const World& world, std::size_t action);

  /// @param observation  [model.spec.size()]
  void observe(std::span<float> observation) const { policy::observe(memory_, *model_, observation); }

  [[nodiscard]] const EpisodeRecord& record() const { return record_; }
  /// Where the vehicle is.
  [[nodiscard]] NorthEast position() const { return position_; }
  /// Where navigation believes it.
  [[nodiscard]] NorthEast believed_position() const { return position_ + navigation_error_; }
  /// The source, the nearest of several.
  [[nodiscard]] NorthEast source() const { return source_; }
  [[nodiscard]] policy::Reception reception() const { return reception_; }
  /// The SNR of the reception; where it was too faint to measure, the least that could have been measured.
  [[nodiscard]] Decibels snr() const { return reception_.snr; }
  /// What is believed about the source; meaningful only when the model's spec needs it.
  [[nodiscard]] const policy::OceanBelief& belief() const { return memory_.belief(); }

 private:
  void step_and_listen(const World& world, NorthEast through_water);
  void move(const World& world, NorthEast through_water, double time_s);
  [[nodiscard]] NorthEast in_domain(const World& world) const { return believed_position() - world.settings.domain.south_west; }

  NorthEast position_;
  NorthEast source_;
  NorthEast navigation_error_;
  policy::Reception reception_;
  Surroundings surroundings_;
  const policy::ObservationModel* model_ = nullptr;
  const policy::OceanTables* tables_ = nullptr;
  policy::SearchMemory memory_;
  EpisodeRecord record_;
};

}  // namespace earshot::search
