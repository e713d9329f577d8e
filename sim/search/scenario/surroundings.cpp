#include "sim/search/scenario/surroundings.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "firmware/core/compass.hpp"
#include "firmware/core/math.hpp"

namespace earshot::search {
namespace {

UnitNorthEast toward(Radians bearing) {
  const SineCosine turned = sine_cosine(bearing);
  return {turned.cosine, turned.sine};
}

Radians any_bearing(Pcg32& random) {
  return Radians{2.0 * std::numbers::pi * random.uniform_double()};
}

/// Mirrors what lies beyond an edge; the component of the course turns with it.
void reflect(Meters& x, double& course, Meters low, Meters high) {
  if (x < low) {
    x = std::min(low + (low - x), high);
    course = -course;
  } else if (x > high) {
    x = std::max(high - (x - high), low);
    course = -course;
  }
}

constexpr Decibels kSilence{-std::numeric_limits<double>::infinity()};

}  // namespace

Pcg32 Surroundings::stream_from(const World& world, Pcg32& random) {
  if (world.is_calm()) return Pcg32(0);
  const std::uint64_t high = random.next();
  const std::uint64_t seed = (high << 32U) | random.next();
  return Pcg32(seed);
}

void Surroundings::start(const World& world, NorthEast vehicle, NorthEast source, Pcg32 random) {
  const Conditions& c = world.conditions;
  *this = {};
  is_calm_ = world.is_calm();
  if (is_calm_) return put({.position = source, .course = {}});
  random_ = random;
  ocean_ = random_.next() % world.soundscape->ocean_count();
  level_offset_ = (2.0 * random_.uniform_double() - 1.0) * c.source_level_spread;
  fluctuation_ = c.fluctuation;
  if (c.least_fluctuation) fluctuation_ = *c.least_fluctuation + random_.uniform_double() * (c.fluctuation - *c.least_fluctuation);
  const Radians drawn_current = any_bearing(random_);
  current_toward_ = toward(c.current ? c.current->toward.value_or(drawn_current) : drawn_current);
  add_source(world, source);
  while (sources_.size() < c.sources) {
    const NorthEast further = uniform_in(world.settings.domain, random_);
    if (range_between(further, vehicle) > world.settings.step_length) add_source(world, further);
  }
}

void Surroundings::add_source(const World& world, NorthEast position) {
  Source source{.position = position, .course = toward(any_bearing(random_)), .field = world.soundscape->field_of(ocean_, position)};
  const double fraction = random_.uniform_double();
  if (const auto& calls = world.conditions.calls) source.sung_s = fraction * (calls->song_s + calls->pause_s);
  put(source);
}

void Surroundings::put(const Source& source) {
  [[maybe_unused]] const Status status = sources_.push_back(source);
  assert(status == Status::kOk);
}

NorthEast Surroundings::pass(const World& world, NorthEast through_water, double time_s) {
  if (is_calm_) return through_water;
  const Conditions& c = world.conditions;
  now_s_ += time_s;
  if (length_of(through_water).value > 0.0) course_ = bearing_of(through_water.north.value, through_water.east.value);
  if (c.source_speed.value > 0.0) {
    for (Source& source : sources_) swim(world, source, time_s);
  }
  if (c.drift_m_per_sqrt_km > 0.0) {
    const Meters sigma{c.drift_m_per_sqrt_km * std::sqrt(length_of(through_water).value / 1'000.0)};
    drift_ = drift_ + NorthEast{normal() * sigma, normal() * sigma};
  }
  if (!c.current) return through_water;
  const NorthEast carried = Meters{c.current->speed.value * time_s} * current_toward_;
  if (c.current->navigation == Current::Navigation::kDoesNotSeeIt) unseen_current_ = unseen_current_ + carried;
  return through_water + carried;
}

NorthEast Surroundings::carry(const World& world, NorthEast from, NorthEast to, double time_s) {
  return is_calm_ ? to : from + pass(world, to - from, time_s);
}

void Surroundings::swim(const World& world, Source& source, double time_s) {
  const Rectangle& domain = world.settings.domain;
  source.position = source.position + Meters{world.conditions.source_speed.value * time_s} * source.course;
  reflect(source.position.north, source.course.north, domain.south_west.north, domain.north_east.north);
  reflect(source.position.east, source.course.east, domain.south_west.east, domain.north_east.east);
  source.field = world.soundscape->field_of(ocean_, source.position);
}

Decibels Surroundings::draw_snr(const World& world, const Source& source, NorthEast vehicle) {
  Decibels snr = world.soundscape->snr(source.field, source.position, vehicle) + level_offset_;
  if (fluctuation_.value > 0.0) snr += normal() * fluctuation_;
  return snr;
}

messages::Bearing Surroundings::draw_bearing(const BearingConditions& array, const Source& source, NorthEast vehicle) {
  const NorthEast way = source.position - vehicle;
  const Radians heard = bearing_of(way.north.value, way.east.value) + normal() * array.deviation;
  if (!array.is_ambiguous) return {.direction = wrap_to_two_pi(heard), .deviation = array.deviation};
  const Radians off_course = wrap_to_pi(heard - course_);
  const Radians to_starboard = off_course.value < 0.0 ? -off_course : off_course;
  return {.direction = wrap_to_two_pi(course_ + to_starboard), .deviation = array.deviation, .mirror_axis = wrap_to_two_pi(course_)};
}

policy::Reception Surroundings::listen(const World& world, NorthEast vehicle) {
  if (is_calm_) return {.snr = world.expected().at(range_between(vehicle, sources_[0].position))};
  return reception_of(world, arrivals(world, vehicle));
}

Arrivals Surroundings::arrivals(const World& world, NorthEast vehicle) {
  const auto& calls = world.conditions.calls;
  const auto& array = world.conditions.bearing;
  Arrivals arrivals;
  for (const Source& source : sources_) {
    Arrival arrival{.range = range_between(vehicle, source.position),
                    .snr = draw_snr(world, source, vehicle),
                    .has_called = !calls || has_called(*calls, source),
                    .sung_s = source.sung_s};
    if (array) arrival.bearing = draw_bearing(*array, source, vehicle);
    [[maybe_unused]] const Status status = arrivals.push_back(arrival);
    assert(status == Status::kOk);
  }
  return arrivals;
}

policy::Reception Surroundings::reception_of(const World& world, const Arrivals& arrivals) const {
  if (is_calm_) return {.snr = arrivals[0].snr};
  policy::Reception loudest{.snr = kSilence};
  for (const Arrival& arrival : arrivals) {
    if (arrival.has_called && arrival.snr > loudest.snr) loudest = {.snr = arrival.snr, .too_faint = false, .bearing = arrival.bearing};
  }
  const std::optional<Decibels>& floor = world.conditions.floor;
  if (floor && !(loudest.snr >= *floor)) return {.snr = *floor, .too_faint = true};
  return loudest;
}

bool Surroundings::has_called(const CallPattern& calls, const Source& source) const {
  const double in_cycle_s = std::fmod(source.sung_s + now_s_, calls.song_s + calls.pause_s);
  const double last_call = std::ceil(calls.song_s / calls.interval_s) - 1.0;  // of a song, counted from 0
  const double latest = std::min(std::floor(in_cycle_s / calls.interval_s), last_call);
  return in_cycle_s - latest * calls.interval_s < calls.listening_s;
}

NorthEast Surroundings::nearest_source(NorthEast vehicle) const {
  return std::ranges::min_element(sources_, {}, [vehicle](const Source& s) { return range_between(s.position, vehicle); })->position;
}

/// Source: Box and Muller, Ann. Math. Statist. 29 (1958) 610.
double Surroundings::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random_.uniform_double()));
  return radius * sine_cosine(Radians{2.0 * std::numbers::pi * random_.uniform_double()}).cosine;
}

}  // namespace earshot::search
