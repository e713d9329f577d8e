// Row search.decision_us: how long the shipped policy takes to decide with the tables that ship, belief update included; "peer" measures a
// plain Bayes chase instead. Row search.ponder_us: "ponder" measures a slice of how the belief refines its hypotheses between two
// decisions.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/host/policy/tables_choice.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "tests/bench/short_form.hpp"

namespace {

using namespace earshot;

const int kSearches = bench::full_or_short(100, 8);
constexpr int kDecisions = 25;  // of each, about what a search takes

/// In the first ocean of the tables, at its ranges.
double snr_db_at(const policy::OceanTables& tables, Meters range) {
  const auto at = static_cast<std::size_t>(range / tables.range_step);
  return double{tables.tables[0].snr_db(std::min(at, tables.range_count - std::size_t{1}))};
}

/// The belief as one would write it down: double, one ocean and one hypothesis, every likelihood computed at every cell; goes to the
/// likeliest.
class PlainBayes {
 public:
  explicit PlainBayes(const policy::OceanTables& tables) : tables_(tables) {}
  void start() { cells_.assign(2500, 1.0 / 2500.0); }
  std::size_t decide(const policy::BeliefModel& model, NorthEast place, policy::Reception reception) {
    double total = 0.0;
    std::size_t best = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double range = std::hypot(centre(i).north.value - place.north.value, centre(i).east.value - place.east.value);
      const double z = (reception.snr.value - snr_db_at(tables_, Meters{range})) / 4.0;
      cells_[i] *= range < model.step_length.value ? 1e-3 : 0.98 * std::exp(-0.5 * z * z) + 0.02;
      total += cells_[i];
      if (cells_[i] > cells_[best]) best = i;
    }
    for (double& cell : cells_) cell /= total;
    std::size_t action = 0;
    double least = 1e9;
    for (std::size_t a = 0; a < model.actions.size(); ++a) {
      const double left = range_between(place + model.step_length * model.actions[a], centre(best)).value;
      if (left < least) action = a;
      least = std::min(least, left);
    }
    return action;
  }
  bool refine() { return false; }

 private:
  static NorthEast centre(std::size_t i) {
    return {Meters{(static_cast<double>(i / 50) + 0.5) * 500.0}, Meters{(static_cast<double>(i % 50) + 0.5) * 500.0}};
  }
  const policy::OceanTables& tables_;
  std::vector<double> cells_;
};

/// As the runtime decides (firmware/runtime): remember, observe, find logits, draw.
class Shipped {
 public:
  Shipped(const policy::FrozenPolicy& policy, const policy::OceanTables& tables) : policy_(policy), tables_(tables) {}
  void start() { fresh_ = true; }
  std::size_t decide(const policy::BeliefModel&, NorthEast place, policy::Reception reception) {
    if (fresh_) {
      memory_->start(policy_.observation, tables_, place, reception);
    } else {
      memory_->remember(policy_.observation, tables_, place, reception);
    }
    fresh_ = false;
    std::array<float, config::kMaxObservation> observation{};
    std::array<float, config::kMaxActions> logits{};
    const std::span<float> seen = std::span(observation).first(policy_.observation.spec.size());
    const std::span<float> scores = std::span(logits).first(policy_.actions.size());
    policy::observe(*memory_, policy_.observation, seen);
    policy::find_logits(policy_, seen, scores);
    return policy::draw_action(policy_.draw, scores, random_);
  }
  bool refine() { return memory_->refine(policy_.observation, tables_); }

 private:
  const policy::FrozenPolicy& policy_;
  const policy::OceanTables& tables_;
  std::unique_ptr<policy::SearchMemory> memory_ = std::make_unique<policy::SearchMemory>();
  Pcg32 random_{1};
  bool fresh_ = true;
};

/// What is timed.
enum class Timed { kDecision, kSlice };

/// Median microseconds over whole searches, sources and starts everywhere; the vehicle stays in the area, and refines between decisions.
/// Wrong: it does not go where it is told.
/// @throws std::runtime_error: fewer than half of the searches come near their source, or a belief that refines nothing
template <class Decider>
double median_us(Decider decider, Timed timed, const policy::BeliefModel& model, const policy::OceanTables& tables) {
  Pcg32 random(3);
  const auto anywhere = [&random] {
    return NorthEast{Meters{25'000.0 * random.uniform_double()}, Meters{25'000.0 * random.uniform_double()}};
  };
  std::vector<double> spent_us;
  int came_near = 0;
  int slices = 0;
  const auto time = [&spent_us](bool counts, const auto& work) {
    const auto began = std::chrono::steady_clock::now();
    const auto result = work();
    if (counts) spent_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - began).count());
    return result;
  };
  for (int search = 0; search < kSearches; ++search) {
    const NorthEast source = anywhere();
    NorthEast place = anywhere();
    Meters nearest = range_between(place, source);
    decider.start();
    for (int i = 0; i < kDecisions; ++i) {
      const policy::Reception measurement{.snr = Decibels{snr_db_at(tables, range_between(place, source))}};
      const std::size_t action = time(timed == Timed::kDecision, [&] { return decider.decide(model, place, measurement); });
      while (time(timed == Timed::kSlice, [&] { return decider.refine(); })) ++slices;
      if (!bench::is_wrong_on_purpose()) place = place + model.step_length * model.actions[action];
      nearest = std::min(nearest, range_between(place, source));
    }
    if (nearest <= 2.0 * model.step_length) ++came_near;
  }
  if (2 * came_near < kSearches)
    throw std::runtime_error("nothing decides: " + std::to_string(came_near) + " of " + std::to_string(kSearches) +
                             " searches come near the source");
  if (timed == Timed::kSlice && slices == 0) throw std::runtime_error("nothing is pondered");
  const auto middle = spent_us.begin() + static_cast<std::ptrdiff_t>(spent_us.size() / 2);
  std::ranges::nth_element(spent_us, middle);
  return *middle;
}

}  // namespace

int main(int argc, char** argv) try {
  const auto policy = host::load_unverified_policy(EARSHOT_SOURCE_DIR "/policy/frozen/shipped.policy");
  const policy::SearchedSound paper{.vehicle_depth = Meters{300.0}, .frequency = Hertz{20.0}, .furthest = Meters{35'356.0}};
  const std::filesystem::path shipped[] = {EARSHOT_SOURCE_DIR "/policy/tables/shipped"};
  const host::TablesFile tables = host::tables_for(shipped, paper, "bench_decision");
  const policy::BeliefModel& model = policy->observation.belief;
  const bool peer = argc > 1 && std::strcmp(argv[1], "peer") == 0;
  const Timed timed = argc > 1 && std::strcmp(argv[1], "ponder") == 0 ? Timed::kSlice : Timed::kDecision;
  double best = 1e9;  // of five, in short of one: what else the machine does only ever adds
  for (int round = 0; round < bench::full_or_short(5, 1); ++round) {
    best = std::min(best, peer ? median_us(PlainBayes(*tables.tables), timed, model, *tables.tables)
                               : median_us(Shipped(*policy, *tables.tables), timed, model, *tables.tables));
  }
  std::printf("{\"value\": %.2f}\n", best);
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
