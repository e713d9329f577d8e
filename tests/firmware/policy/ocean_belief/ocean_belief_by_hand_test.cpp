#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "tests/firmware/emulated.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_belief_rig.hpp"

namespace earshot::policy {
namespace {

/// Whether the source was declared found after each measurement.
using Declared = std::vector<bool>;
using Joint = std::vector<double>;  ///< [cell that the source began in]

Joint moved_by_hand(const Joint& joint, std::uint8_t mobility) {
  constexpr std::array<double, 4> kPenalty{0.0, 0.125, 0.5, 0.5};
  constexpr std::array<int, 4> kReach{0, 1, 1, 2};
  const int far = kReach[mobility];
  if (far == 0) return joint;
  Joint moved(400);
  for (int i = 0; i < 400; ++i) {
    for (int n = std::max(0, i / 20 - far); n <= std::min(19, i / 20 + far); ++n) {
      for (int e = std::max(0, i % 20 - far); e <= std::min(19, i % 20 + far); ++e) {
        const auto cells = static_cast<double>(std::abs(n - i / 20) + std::abs(e - i % 20));
        double& to = moved[static_cast<std::size_t>(i)];
        to = std::max(to, std::pow(kPenalty[mobility], cells) * joint[static_cast<std::size_t>(n * 20 + e)]);
      }
    }
  }
  const double scale = std::accumulate(joint.begin(), joint.end(), 0.0) / std::accumulate(moved.begin(), moved.end(), 0.0);
  for (double& p : moved) p *= scale;
  return moved;
}

/// No place gets less likely than the likeliest by more than 2^-26.
void keep_forgotten(Joint& joint) {
  const double least = std::ldexp(*std::ranges::max_element(joint), -26);
  for (double& p : joint) p = std::max(p, least);
}

/// By hand: each retained hypothesis, weighed by its prior and by all that was heard, before each of which the source may have moved,
/// and has drifted. Where it was declared found and the search went on it is not within a step.
class OceanBeliefByHand : public OceanBeliefRig {
 protected:
  /// Hears it all from the start. @return when it declared the source found
  Declared fly(const Measurements& measurements) {
    belief->start(model, tables);
    Declared declared;
    for (const auto& [place, reception] : measurements) {
      belief->update(model, tables, place, reception);
      declared.push_back(belief->declaration().has_value());
    }
    return declared;
  }

  /// Half a unit of 0.14 % is rounded at every measurement, in the evidence and in every movement; from the sum over all hypotheses those
  /// below 1e-4 are left out, and where one drifts a place a millionth as likely as its likeliest. One whose source moves heard a bearing
  /// too early where it was being weighed when that came.
  void expect_by_hand(const Measurements& measurements, const Declared& declared, double tolerance) const {
    std::vector<Joint> joint;
    double total = 0.0;
    for (const Hypothesis& h : retained()) {
      joint.push_back(joint_by_hand(h, measurements, declared));
      total += std::accumulate(joint.back().begin(), joint.back().end(), 0.0);
    }
    const auto measurement_count = static_cast<int>(measurements.size());
    const bool has_bearings =
        std::ranges::any_of(measurements, [](const auto& measurement) { return measurement.second.bearing.has_value(); });
    const Drift current = likeliest_current(*belief);
    const NorthEast corner = at(62.5 * current.north * measurement_count, 62.5 * current.east * measurement_count);
    Joint by_place(400);  // by the next measurement, in the area as the current has carried it
    Joint left_out(400);
    for (std::size_t k = 0; k < joint.size(); ++k) {
      const double share = std::accumulate(joint[k].begin(), joint[k].end(), 0.0) / total;
      const double too_early = has_bearings && belief->hypothesis(k).mobility > 0 ? 1e-4 : 0.0;
      EXPECT_NEAR(double{belief->share(k)}, share, tolerance * share + too_early + 1e-9) << k;
      Joint of_one(400);  // in the area where it was
      for (std::size_t i = 0; i < 400; ++i) {
        const NorthEast place = drifted(retained()[k].drift, measurement_count, i);
        by_place[cell_at(place - corner)] += joint[k][i];
        if (share < 1.1e-4) left_out[cell_at(place - corner)] += joint[k][i];
        of_one[cell_at(place)] += joint[k][i];
      }
      std::vector<float> added(400);
      belief->add_joint(model, k, added);
      for (std::size_t i = 0; i < 400; ++i) {
        const double expected = of_one[i] / total;
        ASSERT_NEAR(double{added[i]}, expected, tolerance * expected + too_early + 1e-5) << k << ", " << i;
      }
    }
    for (std::size_t i = 0; i < 400; ++i) {
      const double expected = by_place[i] / total;
      const double allowed = tolerance * expected + left_out[i] / total + 1e-6;
      ASSERT_NEAR(double{belief->probability(model, i / 20, i % 20)}, expected, allowed) << i;
    }
  }

 private:
  /// What a bearing says of a place: in the area of the cell that it is in.
  [[nodiscard]] static double said_of(NorthEast place, NorthEast vehicle, const messages::Bearing& bearing) {
    const auto is_within = [](Meters x) { return x.value >= 0.0 && x.value <= 10'000.0; };
    return is_within(place.north) && is_within(place.east) ? bearing_likelihood_by_hand(vehicle, bearing, cell_at(place))
                                                           : bearing_likelihood_by_hand(vehicle, bearing, place);
  }

  /// Probability of every cell together with all that was heard, under a hypothesis.
  [[nodiscard]] Joint joint_by_hand(const Hypothesis& h, const Measurements& measurements, const Declared& declared) const {
    Joint p(400, std::exp2(static_cast<double>(log_prior(h, tables)) / 512.0));
    for (std::size_t measurement = 0; measurement < measurements.size(); ++measurement) {
      const auto& [place, reception] = measurements[measurement];
      const auto now = [&h, measurement](std::size_t cell) { return drifted(h.drift, static_cast<int>(measurement), cell); };
      keep_forgotten(p);
      p = moved_by_hand(p, h.mobility);
      if (reception.bearing) {
        for (std::size_t i = 0; i < 400; ++i) p[i] *= said_of(now(i), place, *reception.bearing);
        keep_forgotten(p);
      }
      const std::vector<double> by_range = likelihoods_by_hand(model, tables, h, reception);
      std::vector<std::size_t> ranges;
      for (std::size_t i = 0; i < 400; ++i) {
        const long steps = std::lround(range_between(place, now(i)) / tables.range_step);
        ranges.push_back(static_cast<std::size_t>(std::min(steps, long{tables.range_count - 1})));
        p[i] *= by_range[ranges[i]];
      }
      keep_forgotten(p);
      for (std::size_t i = 0; i < 400 && declared[measurement]; ++i) p[i] *= left_of_cell(model, tables, ranges[i]);
    }
    keep_forgotten(p);
    return p;
  }
};

TEST_F(OceanBeliefByHand, IsTheMixtureByHandOfTheHypothesesThatItHolds) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  const Measurements measurements = {{at(3'200, 4'100), {.snr = Decibels{23.0}}},
                                     {at(-1'000, 2'000), {.snr = Decibels{17.0}, .too_faint = true}},
                                     {at(8'000, -1'500), {.snr = Decibels{17.0}}},
                                     {at(4'000, 5'300), {.snr = Decibels{25.0}}}};
  EXPECT_EQ(fly(measurements), Declared(measurements.size(), false)) << "so that nothing is ruled out, though the search goes on";
  expect_by_hand(measurements, Declared(measurements.size(), false), 0.01);
}

constexpr auto kFourPerKilometre = [](double km) { return 45.0 - 4.0 * km; };
constexpr Drift kSwims{.north = 9, .east = -5};
constexpr Drift kCurrent{.north = 4, .east = 4, .is_current = true};
constexpr std::array kDrifts{kCurrent, kSwims};

/// Measurements to and fro, south of a source that drifts.
Measurements south_of(const Drift& drift) {
  Measurements measurements;
  for (int i = 0; i < 20; ++i) {
    const NorthEast place = at(400.0 * i, i % 2 == 0 ? 2'000.0 : 4'000.0);
    measurements.push_back(
        {place, {.snr = Decibels{kFourPerKilometre(range_between(place, drifted(drift, i, 16 * 20 + 16)).value / 1'000.0)}}});
  }
  return measurements;
}

/// Of a source that swims, and of one that a current takes beyond the edge.
TEST_F(OceanBeliefByHand, IsTheMixtureByHandOfThoseThatDriftToo) {
  add_table(tables, 1.0F, kFourPerKilometre);
  for (const Drift& drift : kDrifts) {
    const Measurements measurements = south_of(drift);
    const Declared declared = fly(measurements);
    EXPECT_EQ(std::ranges::count(declared, true), 0) << "it never gets near";
    EXPECT_GT(retained_that_drift(), 5);
    EXPECT_EQ(likeliest_current(*belief).is_current, drift.is_current);
    expect_by_hand(measurements, declared, 0.02);
  }
}

/// Of where it is then, whether a hypothesis was retained when a bearing came or drawn later; beyond the edge too.
TEST_F(OceanBeliefByHand, TakesBearingsInUnderThoseThatDrift) {
  add_table(tables, 1.0F, kFourPerKilometre);
  for (const Drift& drift : std::span(kDrifts).first<tests::times(2, 1)>()) {
    const std::array<std::vector<std::size_t>, 2> some_and_one{{{2, 9, 15}, {19}}};
    for (const std::vector<std::size_t>& with_bearing : std::span(some_and_one).first<tests::times(2, 1)>()) {
      Measurements measurements = south_of(drift);
      for (const std::size_t i : with_bearing) {
        const NorthEast way = drifted(drift, static_cast<int>(i), 16 * 20 + 16) - measurements[i].first;
        const double direction = std::atan2(way.east.value, way.north.value) + 0.1;
        measurements[i].second.bearing = messages::Bearing{.direction = Radians{direction}, .deviation = Radians{0.2}};
      }
      const Declared declared = fly(measurements);
      EXPECT_GT(retained_that_drift(), 5);
      expect_by_hand(measurements, declared, 0.02);
    }
  }
}

/// A bearing with every measurement, so that some come while others are being weighed that have heard only a part of the measurements:
/// those hear it, too, and are as likely as had they been retained all the time.
TEST_F(OceanBeliefByHand, TakesABearingInUnderThoseThatAreBeingWeighedWhenItComes) {
  add_table(tables, 1.0F, kFourPerKilometre);
  Measurements measurements = south_of({});
  for (auto& [place, reception] : measurements) {
    const NorthEast way = drifted({}, 0, 16 * 20 + 16) - place;
    reception.bearing =
        messages::Bearing{.direction = Radians{std::atan2(way.east.value, way.north.value) + 0.1}, .deviation = Radians{0.3}};
  }
  expect_by_hand(measurements, fly(measurements), 0.02);
}

/// The vehicle hears a source from afar, then goes past it as it drifts on. @param past  from measurement to measurement, as the source
/// sees it
Measurements past_one_that(const Drift& drift, NorthEast past) {
  Measurements measurements = south_of(drift);
  for (int i = 20; i < 30; ++i) {
    const NorthEast source = drifted(drift, i, 16 * 20 + 16);
    const NorthEast place = source + at(past.north.value * (i - 23), past.east.value * (i - 23));
    measurements.push_back({place, {.snr = Decibels{kFourPerKilometre(range_between(place, source).value / 1'000.0)}}});
  }
  return measurements;
}

TEST_F(OceanBeliefByHand, DeclaresASourceFoundThatDriftsAndThenRulesOutWhereItWouldHaveBeenThen) {
  add_table(tables, 1.0F, kFourPerKilometre);
  for (const Drift& drift : std::span(kDrifts).first<tests::times(2, 1)>()) {
    int declared_before_the_last = 0;
    const std::array passes{at(-100, 300), at(-300, 900), at(300, 500), at(0, -700)};
    for (const NorthEast past : std::span(passes).first<tests::times(4, 1)>()) {
      const Measurements measurements = past_one_that(drift, past);
      belief->start(model, tables);
      Declared declared;
      for (const auto& [place, reception] : measurements) {
        belief->update(model, tables, place, reception);
        declared.push_back(belief->declaration().has_value());
        if (!declared.back()) continue;
        EXPECT_LT(range_between(belief->declaration()->likeliest, place).value, 2'000.0) << "within a step, or next to it";
        declared_before_the_last += declared.size() < measurements.size() ? 1 : 0;
      }
      EXPECT_GT(retained_that_drift(), 5);
      expect_by_hand(measurements, declared, 0.02);
    }
    EXPECT_GE(declared_before_the_last, 1);
  }
}

/// 40 dB at the source, ten less per kilometre.
constexpr auto kTenPerKilometre = [](double km) { return 40.0 - 10.0 * km; };

/// On the way to a source, past it and away, as it is heard.
Measurements past(NorthEast source) {
  Measurements measurements;
  for (const NorthEast place : {at(2'000, 2'000), at(2'000, 6'000), at(4'000, 7'000), at(6'000, 6'000), at(6'100, 4'100), at(8'000, 3'000),
                                at(9'000, 6'000), at(7'000, 8'000), at(5'000, 9'000)})
    measurements.push_back({place, {.snr = Decibels{kTenPerKilometre(range_between(place, source).value / 1'000.0)}}});
  return measurements;
}

TEST_F(OceanBeliefByHand, DeclaresTheSourceFoundWhereItIsAndThenRulesThatOutInEveryHypothesisThatItHoldsOrTakesUp) {
  add_table(tables, 1.0F, kTenPerKilometre);
  const NorthEast source = at(6'200, 4'300);
  const Measurements measurements = past(source);
  belief->start(model, tables);
  Declared declared;
  std::vector<Hypothesis> at_declaration;
  for (const auto& [place, reception] : measurements) {
    belief->update(model, tables, place, reception);
    declared.push_back(belief->declaration().has_value());
    if (!declared.back()) continue;
    at_declaration = retained();
    EXPECT_LT(range_between(place, source).value, 1'000.0);
    EXPECT_LT(range_between(belief->declaration()->likeliest, source).value, 500.0);
    EXPECT_DOUBLE_EQ(belief->declaration()->closest_approach.value, range_between(belief->declaration()->likeliest, place).value);
    EXPECT_EQ(belief->declaration()->measurement, declared.size() - 1);
    EXPECT_EQ(belief->declaration()->snr, reception.snr);
    EXPECT_LE(belief->declaration()->least_snr, reception.snr);
    EXPECT_GE(belief->declaration()->near_measurements, 1U);
    EXPECT_GE(belief->declaration()->probability,
              belief->declaration()->near_measurements < kNearMeasurements ? kFoundProbability : kNearProbability);
    EXPECT_GT(range_between(belief->summary().likeliest, place).value, 750.0) << "of a search that goes on";
  }
  EXPECT_EQ(std::ranges::count(declared, true), 1) << "not again, where it was not";
  EXPECT_NE(retained(), at_declaration) << "others were taken up since";
  expect_by_hand(measurements, declared, 0.01);
}

/// A spread of 1 to 7 dB and a level unknown by 9: 20 dB a kilometre away is as it should be, a tenth of a decibel is not.
TEST_F(OceanBeliefByHand, DeclaresNothingFoundThatPausesOrThatIsFarFainterThanItShouldBe) {
  add_table(tables, 1.0F, kTenPerKilometre);
  const NorthEast source = at(6'200, 4'300);
  for (const Reception unheard : {Reception{.snr = Decibels{3.0}, .too_faint = true}, Reception{.snr = Decibels{0.1}}}) {
    belief->start(model, tables);
    for (const auto& [place, reception] : past(source)) {
      if (range_between(place, source).value < 1'000.0) {
        belief->update(model, tables, place, unheard);
        EXPECT_FALSE(belief->declaration());
      } else {
        belief->update(model, tables, place, reception);
      }
    }
  }
}

TEST_F(OceanBeliefByHand, CountsMeasurementsAndForgetsItsDeclarationWhenItStarts) {
  add_table(tables, 1.0F, kTenPerKilometre);
  const Measurements measurements = past(at(6'200, 4'300));
  for (int search = 0; search < 2; ++search) {
    belief->start(model, tables);
    EXPECT_FALSE(belief->declaration());
    for (std::size_t i = 0; i < 5; ++i) belief->update(model, tables, measurements[i].first, measurements[i].second);
    ASSERT_TRUE(belief->declaration());
    EXPECT_EQ(belief->declaration()->measurement, 4U);
  }
}

/// As loud within 1.3 km as can be, silent beyond: of places that are as likely 59 % are within a step, too few for a declaration before
/// the eighth measurement.
TEST_F(OceanBeliefByHand, CountsNoMeasurementNearTheSourceOfTheSearchBefore) {
  add_table(tables, 1.0F, [](double km) { return km < 1.3 ? 30.0 : -20.0; });
  belief->start(model, tables);
  for (int measurement = 0; measurement < 5; ++measurement) {
    hear(at(5'000, 5'000), 30.0);
    EXPECT_FALSE(belief->declaration()) << measurement;
  }
  belief->start(model, tables);
  for (std::uint32_t measurement = 1; measurement < kNearMeasurements; ++measurement) {
    hear(at(5'000, 5'000), 30.0);
    EXPECT_FALSE(belief->declaration()) << "after look " << measurement << " of the second search";
  }
  hear(at(5'000, 5'000), 30.0);
  ASSERT_TRUE(belief->declaration());
  EXPECT_EQ(belief->declaration()->near_measurements, kNearMeasurements);
}

}  // namespace
}  // namespace earshot::policy
