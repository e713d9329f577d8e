#include "policy/training/learning_curve.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

#include "firmware/host/text/numbers.hpp"
#include "policy/evaluate/evaluation.hpp"

namespace earshot::training {
namespace {

constexpr std::string_view kUpdatesHeader =
    "steps,episodes,median_reward_50,found_fraction_50,policy_loss,value_loss,entropy_nats,approximate_kl_nats,clip_fraction,"
    "gradient_norm,explained_variance,learning_rate,minibatches\n";

/// The shortest digits that read back as the same number.
template <class Number>
void append(std::string& text, Number value, char end) {
  text += host::shortest(value) + end;
}

template <class Number>
Number take(std::string_view& text, char end) {
  Number value{};
  const auto done = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto length = static_cast<std::size_t>(done.ptr - text.data());
  if (done.ec != std::errc() || length == text.size() || text[length] != end) throw std::invalid_argument("not a learning curve");
  text.remove_prefix(length + 1);
  return value;
}

}  // namespace

bool take_row(std::string_view& csv, EpisodeRow& row) {
  if (csv.empty()) return false;
  row.episode = take<std::uint64_t>(csv, ',');
  row.steps = take<std::uint64_t>(csv, ',');
  row.reward = take<double>(csv, ',');
  row.found = take<int>(csv, '\n') != 0;
  return true;
}

LearningCurve::LearningCurve() : episodes_csv_(kEpisodesHeader), updates_csv_(kUpdatesHeader) {}

LearningCurve::LearningCurve(std::string episodes_csv, std::string updates_csv)
    : episodes_csv_(std::move(episodes_csv)), updates_csv_(std::move(updates_csv)) {
  std::string_view left = episodes_csv_;
  if (!left.starts_with(kEpisodesHeader) || !updates_csv_.starts_with(kUpdatesHeader)) throw std::invalid_argument("not a learning curve");
  left.remove_prefix(kEpisodesHeader.size());
  for (EpisodeRow row; take_row(left, row);) remember({row.reward, row.found});
}

void LearningCurve::remember(Outcome outcome) {
  ++episodes_;
  recent_.push_back(outcome);
  if (recent_.size() > kRecentEpisodes) recent_.pop_front();
}

void LearningCurve::add(const search::EpisodeRecord& episode, std::uint64_t steps) {
  const bool found = episode.end == search::EpisodeEnd::kFound;
  remember({episode.reward, found});
  append(episodes_csv_, episodes_, ',');
  append(episodes_csv_, steps, ',');
  append(episodes_csv_, episode.reward, ',');
  append(episodes_csv_, found ? 1 : 0, '\n');
}

void LearningCurve::add(const ppo::UpdateReport& update, std::uint64_t steps) {
  const Recent last = recent();
  append(updates_csv_, steps, ',');
  append(updates_csv_, episodes_, ',');
  for (const double value : {last.median_reward, last.found_fraction}) {
    if (last.episodes > 0)
      append(updates_csv_, static_cast<float>(value), ',');
    else
      updates_csv_ += ',';
  }
  for (const double value : {update.policy_loss, update.value_loss, update.entropy, update.approximate_kl, update.clip_fraction,
                             update.gradient_norm, update.explained_variance, update.learning_rate}) {
    append(updates_csv_, static_cast<float>(value), ',');
  }
  append(updates_csv_, update.minibatches, '\n');
}

std::string to_string(const LearningCurve::Recent& recent) {
  if (recent.episodes == 0) return "median reward -, found - %";
  return host::formatted("median reward %.1f, found %.0f %%", recent.median_reward, 100.0 * recent.found_fraction);
}

LearningCurve::Recent LearningCurve::recent_of_all(std::span<const Recent> trainings) {
  Recent all;
  std::vector<double> medians;
  for (const Recent& each : trainings) {
    if (each.episodes == 0) continue;
    all.episodes += each.episodes;
    all.found_fraction += each.found_fraction;
    medians.push_back(each.median_reward);
  }
  if (medians.empty()) return {};
  all.found_fraction /= static_cast<double>(medians.size());
  all.median_reward = evaluate::quantile(std::move(medians), 0.5);
  return all;
}

LearningCurve::Recent LearningCurve::recent() const {
  if (recent_.empty()) return {};
  std::vector<double> rewards;
  for (const Outcome& outcome : recent_) rewards.push_back(outcome.reward);
  const auto found = std::ranges::count(recent_, true, &Outcome::found);
  return {.episodes = recent_.size(),
          .median_reward = evaluate::quantile(std::move(rewards), 0.5),
          .found_fraction = static_cast<double>(found) / static_cast<double>(recent_.size())};
}

}  // namespace earshot::training
