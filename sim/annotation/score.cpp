#include "sim/annotation/score.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace earshot::annotation {
namespace {

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(part) / static_cast<double>(whole);
}

/// Intervals in the order of their ends, each of which can be taken once.
class Line {
 public:
  explicit Line(std::vector<Interval> intervals) : intervals_(std::move(intervals)), is_taken_(intervals_.size()) {
    std::ranges::sort(intervals_, {}, &Interval::end_s);
    for (const Interval& interval : intervals_) longest_s_ = std::max(longest_s_, interval.end_s - interval.begin_s);
  }

  [[nodiscard]] bool is_over() const { return first_ == intervals_.size(); }
  [[nodiscard]] double first_end_s() const { return intervals_[first_].end_s; }
  /// Passes over the one that ends first. @return whether it was still to be had
  bool pass() { return !is_taken_[first_++]; }

  /// Takes the one that ends first of those that begin no later. @return whether there was one
  bool take_one_begun_by(double time_s) {
    // Whatever ends later than this begins later than `time_s`.
    for (std::size_t i = first_; i < intervals_.size() && intervals_[i].end_s <= time_s + longest_s_; ++i) {
      if (is_taken_[i] || intervals_[i].begin_s > time_s) continue;
      is_taken_[i] = true;
      return true;
    }
    return false;
  }

 private:
  std::vector<Interval> intervals_;
  std::vector<bool> is_taken_;
  std::size_t first_ = 0;
  double longest_s_ = 0.0;
};

}  // namespace

double Score::recall() const {
  return ratio(hits, truths);
}

double Score::precision() const {
  return ratio(hits, detections);
}

double Score::false_alarms_per_hour() const {
  return hours > 0.0 ? static_cast<double>(false_alarms()) / hours : std::numeric_limits<double>::quiet_NaN();
}

Score score(std::vector<Interval> truth, std::vector<Interval> found, double tolerance_s, double hours) {
  // A gap of the tolerance between two is no gap once one of them has grown by it on both sides.
  for (Interval& interval : truth) interval = {interval.begin_s - tolerance_s, interval.end_s + tolerance_s};
  Score score{.truths = truth.size(), .detections = found.size(), .hits = 0, .hours = hours};
  Line truths(std::move(truth));
  Line detections(std::move(found));
  while (!truths.is_over() && !detections.is_over()) {
    const bool truth_ends_first = truths.first_end_s() <= detections.first_end_s();
    Line& line = truth_ends_first ? truths : detections;
    Line& other = truth_ends_first ? detections : truths;
    const double end_s = line.first_end_s();
    if (line.pass() && other.take_one_begun_by(end_s)) ++score.hits;
  }
  return score;
}

}  // namespace earshot::annotation
