#include "policy/baselines/patterns.hpp"

#include <algorithm>
#include <cmath>

#include "policy/baselines/moves.hpp"

namespace earshot::baselines {
namespace {

constexpr double kReached = 1.25;  ///< step lengths from a corner: steps of whole lengths that keep out of the border may come no nearer

}  // namespace

std::size_t RandomWalk::choose(const DecisionInput& input) {
  FixedVector<std::size_t, config::kMaxActions> free;
  for (std::size_t action = 0; action < prior_.actions.size(); ++action) {
    if (border_cost(prior_.settings, end_of(prior_, input.position, action)) > 0.0) continue;
    [[maybe_unused]] const Status status = free.push_back(action);
  }
  return free.empty() ? random_.next() % prior_.actions.size() : free[random_.next() % free.size()];
}

Meters assured_detection_range(const PriorKnowledge& prior) {
  const std::vector<float>& snr = prior.snr.samples_db();
  const auto threshold = static_cast<float>(prior.settings.detection_threshold.value);
  const auto first_unheard = std::ranges::find_if(snr, [threshold](float x) { return x < threshold; });
  const auto heard = first_unheard - snr.begin();
  return static_cast<double>(std::max<std::ptrdiff_t>(heard - 1, 0)) * prior.snr.range_step();
}

LawnMower::LawnMower(const PriorKnowledge& prior)
    : prior_(prior), spacing_(2.0 * std::max(assured_detection_range(prior), prior.settings.step_length)) {}

void LawnMower::begin(Pcg32 /*random*/) {
  path_.reset();
  tracks_ = guidance::Tracks::kNorthSouth;
}

void LawnMower::plan_from(NorthEast start) {
  path_.emplace(guidance::TrackPlan{.area = search::inside_border(prior_.settings),
                                    .spacing = spacing_,
                                    .outer = guidance::OuterTracks::kHalfASpacingIn,
                                    .tracks = tracks_},
                start);
  next_ = 0;
}

std::size_t LawnMower::choose(const DecisionInput& input) {
  if (path_ && range_between(input.position, path_->corner(next_)) <= kReached * prior_.settings.step_length) ++next_;
  if (!path_ || next_ >= path_->corner_count()) {
    if (path_) tracks_ = tracks_ == guidance::Tracks::kNorthSouth ? guidance::Tracks::kEastWest : guidance::Tracks::kNorthSouth;
    plan_from(input.position);
  }
  return warily_toward(prior_, input.position, path_->corner(next_));
}

void SweepSearch::begin(Pcg32 /*random*/) {
  sweep_.reset();
}

std::size_t SweepSearch::choose(const DecisionInput& input) {
  const search::SearchSettings& s = prior_.settings;
  if (!sweep_)
    sweep_.emplace(guidance::SweepPlan{.area = s.domain, .margin = s.border_width, .step_length = s.step_length}, input.position);
  return sweep_->next(input.position, prior_.actions.span()).action;
}

void ExpandingSquare::begin(Pcg32 /*random*/) {
  leg_ = 0;
  steps_left_ = 2;
}

void ExpandingSquare::turn() {
  ++leg_;
  steps_left_ = 2 * (leg_ / 2 + 1);
}

std::size_t ExpandingSquare::choose(const DecisionInput& input) {
  const std::size_t quarter = std::max<std::size_t>(prior_.actions.size() / 4, 1);
  if (steps_left_ == 0) turn();
  const auto heading = [&] { return leg_ % 4 * quarter % prior_.actions.size(); };
  for (int turns = 0; turns < 4 && border_cost(prior_.settings, end_of(prior_, input.position, heading())) > 0.0; ++turns) turn();
  --steps_left_;
  return heading();
}

}  // namespace earshot::baselines
