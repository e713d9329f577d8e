#include "firmware/policy/ocean_belief/hypotheses/hypothesis.hpp"

#include <algorithm>

#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

// Prior probabilities; those of each kind add up to one.
constexpr std::array<float, kSpreads_db.size()> kSpreadPriors{0.2F, 0.35F, 0.35F, 0.1F};
constexpr std::array<float, kMobilities.size()> kMobilityPriors{0.8F, 0.1F, 0.06F, 0.04F};

float sum_of_priors(const OceanTables& tables) {
  float sum = 0.0F;
  for (const OceanTable& table : tables.tables) sum += table.prior;
  return sum;
}

/// An index, drawn with the probabilities of which `prior_of` is one of each.
template <class PriorOf>
std::uint8_t draw(std::size_t count, float sum, PriorOf prior_of, Pcg32& random) {
  float left = random.uniform_float() * sum;
  std::size_t i = 0;
  while (i + 1 < count && (left -= prior_of(i)) >= 0.0F) ++i;
  return static_cast<std::uint8_t>(i);
}

template <std::size_t N>
std::uint8_t draw(const std::array<float, N>& priors, Pcg32& random) {
  return draw(
      N, 1.0F, [&priors](std::size_t i) { return priors[i]; }, random);
}

std::uint8_t draw_table(const OceanTables& tables, Pcg32& random) {
  return draw(
      tables.tables.size(), sum_of_priors(tables), [&tables](std::size_t i) { return tables.tables[i].prior; }, random);
}

/// Any of them, each as likely as another: those that the prior thinks unlikely must be tried, too.
std::uint8_t any_table(const OceanTables& tables, Pcg32& random) {
  return static_cast<std::uint8_t>(static_cast<int>(random.uniform_float() * static_cast<float>(tables.tables.size())));
}

std::uint8_t any_mobility(Pcg32& random) {
  return static_cast<std::uint8_t>(1 + static_cast<int>(random.uniform_float() * static_cast<float>(kMobilities.size() - 1)));
}

/// One more or one less, within the `count` there are.
std::uint8_t next_to(std::uint8_t index, std::size_t count, Pcg32& random) {
  const int next = random.uniform_float() < 0.5F ? index - 1 : index + 1;
  return static_cast<std::uint8_t>(std::clamp(next, 0, static_cast<int>(count) - 1));
}

}  // namespace

int log_prior_of_ocean(const Hypothesis& h, const OceanTables& tables) {
  return to_log(tables.tables[h.table].prior) - to_log(sum_of_priors(tables));
}

int log_prior(const Hypothesis& h, const OceanTables& tables) {
  return log_prior_of_ocean(h, tables) + to_log(kLevelPriors[h.level]) + to_log(kSpreadPriors[h.spread]) +
         to_log(kSilencePriors[h.silence]) + to_log(kMobilityPriors[h.mobility]) + log_prior(h.drift);
}

Hypothesis draw_hypothesis(const OceanTables& tables, Motion motion, Pcg32& random) {
  Hypothesis h;
  h.table = draw_table(tables, random);
  h.level = draw(kLevelPriors, random);
  h.spread = draw(kSpreadPriors, random);
  h.silence = draw(kSilencePriors, random);
  if (motion == Motion::kMoving) h.mobility = any_mobility(random);
  return h;
}

Hypothesis draw_neighbour(const Hypothesis& parent, const OceanTables& tables, Motion motion, Pcg32& random) {
  Hypothesis h = parent;
  h.mobility = 0;
  if (motion == Motion::kMoving) h.mobility = parent.mobility > 0 && random.uniform_float() < 0.7F ? parent.mobility : any_mobility(random);
  const float part = random.uniform_float();
  if (part < 0.4F) {
    h.table = any_table(tables, random);
  } else if (part < 0.7F) {
    h.level = next_to(h.level, kLevelOffsets_db.size(), random);
  } else if (part < 0.85F) {
    h.spread = next_to(h.spread, kSpreads_db.size(), random);
  } else {
    h.silence = next_to(h.silence, kSilenceShares.size(), random);
  }
  if (random.uniform_float() < 0.3F) h.table = any_table(tables, random);
  return h;
}

}  // namespace earshot::policy
