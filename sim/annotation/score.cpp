#include "sim/annotation/score.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
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
    by_begin_.resize(intervals_.size());
    std::iota(by_begin_.begin(), by_begin_.end(), std::size_t{0});
    std::ranges::sort(by_begin_, {}, [this](std::size_t i) { return intervals_[i].begin_s; });
  }

  [[nodiscard]] bool is_over() const { return first_ == intervals_.size(); }
  [[nodiscard]] double first_end_s() const { return intervals_[first_].end_s; }
  /// Passes over the one that ends first. @return whether it was still to be had
  bool pass() { return !is_taken_[first_++]; }

  /// Takes the one that ends first of those that begin no later. @return whether there was one
  /// @param time_s  no earlier than before
  bool take_one_begun_by(double time_s) {
    for (; begun_count_ < by_begin_.size() && intervals_[by_begin_[begun_count_]].begin_s <= time_s; ++begun_count_)
      begun_.push(by_begin_[begun_count_]);
    while (!begun_.empty() && begun_.top() < first_) begun_.pop();
    if (begun_.empty()) return false;
    is_taken_[begun_.top()] = true;
    begun_.pop();
    return true;
  }

 private:
  std::vector<Interval> intervals_;
  std::vector<bool> is_taken_;
  std::size_t first_ = 0;
  std::vector<std::size_t> by_begin_;
  std::size_t begun_count_ = 0;
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> begun_;  ///< not taken; the one that ends first on top
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
