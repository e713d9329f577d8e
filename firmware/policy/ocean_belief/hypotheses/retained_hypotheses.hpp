#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/policy/ocean_belief/hypotheses/assumptions.hpp"
#include "firmware/policy/ocean_belief/hypotheses/candidates.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"

namespace earshot::policy {

/// A hypothesis less likely than this changes no decision.
inline constexpr float kLeastShare = 1e-4F;
/// Less likely than any posterior.
inline constexpr int kNoPosterior = std::numeric_limits<int>::min() / 2;

/// The likeliest hypotheses, as many as memory holds. It owns the place under each of them, their posteriors and their shares.
///
/// An index is below kRetainedHypotheses. No hypothesis is retained twice, for it would count twice.
class RetainedHypotheses {
 public:
  /// The likeliest ocean in every way that is not rare, and as many other hypotheses as there is room for.
  void start(const Assumptions& assumed, const PlacePrior& prior);

  /// To be moved and weighed. Whoever weighs them calls find_shares() afterwards.
  [[nodiscard]] std::span<HypothesisBlock> blocks() { return blocks_; }
  /// Finds posteriors and shares of the blocks as they are.
  void find_shares(const Assumptions& assumed);
  /// Replaces the least likely by candidates that are likelier. @param candidates  which have been weighed by every measurement
  void take_the_likelier(const Assumptions& assumed, const HypothesisBlock& candidates);
  /// Posterior beyond which a candidate replaces a retained hypothesis. @param drifts  whether the candidate does
  [[nodiscard]] int least_to_be_retained(bool drifts) const;

  [[nodiscard]] const Hypothesis& hypothesis(std::size_t index) const { return blocks_[index / kLanes].hypothesis(index % kLanes); }
  /// log2 of what is proportional to the probability of a hypothesis, in 1/512.
  [[nodiscard]] int posterior(std::size_t index) const { return posteriors_[index / kLanes][index % kLanes]; }
  /// Probability of a hypothesis; these add up to one.
  [[nodiscard]] float share(std::size_t index) const { return shares_[index / kLanes][index % kLanes]; }
  /// All hypotheses with their shares.
  [[nodiscard]] RetainedShares with_shares() const;
  /// The current that is the likeliest of all; none where it is likelier that there is none.
  [[nodiscard]] Drift likeliest_current() const;

  /// Sums up over the hypotheses where the source is after so many measurements; nothing outside the window.
  /// @param corner    from which the places are counted: that of the area, as a current has carried it
  /// @param marginal  [north x east]; the result
  void find_marginal(const BeliefModel& model, NorthEast corner, std::uint32_t measurements, const CellWindow& window,
                     std::span<float> marginal) const;
  /// Adds the probability of every cell together with that of one hypothesis, after so many measurements. @param joint  [north x east]
  void add_joint(const BeliefModel& model, std::size_t index, std::uint32_t measurements, std::span<float> joint) const;
  /// CRC-32 of all weights. @param crc  of what stands before them
  [[nodiscard]] std::uint32_t fingerprint(const BeliefModel& model, std::uint32_t crc) const;

 private:
  [[nodiscard]] bool holds(const Hypothesis& hypothesis) const;
  [[nodiscard]] std::size_t drifting() const;
  [[nodiscard]] std::size_t least_likely(bool drifts) const;
  void share_out();

  std::array<HypothesisBlock, config::kBeliefBlocks> blocks_;
  // Without initial values: start() writes them, and zeros would take flash and time.
  std::array<std::array<int, kLanes>, config::kBeliefBlocks> posteriors_;
  std::array<FloatLanes, config::kBeliefBlocks> shares_;
};

}  // namespace earshot::policy
