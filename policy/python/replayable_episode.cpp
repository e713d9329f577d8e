#include "policy/python/replayable_episode.hpp"

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::python {

void ReplayableEpisode::begin(const std::optional<Places>& places) {
  before_ = random_;
  places_ = places;
  actions_.clear();
  is_started_ = true;
}

void ReplayableEpisode::start(const SearchProblem& problem) {
  begin({});
  episode_.start(problem.world(), problem.observation(), problem.tables(), random_);
}

void ReplayableEpisode::start_at(const SearchProblem& problem, const Places& places) {
  begin(places);
  episode_.start_at(problem.world(), problem.observation(), problem.tables(), places.position, places.source, random_);
}

double ReplayableEpisode::step(const SearchProblem& problem, std::size_t action) {
  static_assert(config::kMaxActions <= 256);  // a byte each
  actions_.push_back(static_cast<char>(action));
  return episode_.step(problem.world(), action);
}

EpisodeHistory ReplayableEpisode::history() const {
  return {.random = (is_started_ ? before_ : random_).state(), .is_started = is_started_, .places = places_, .actions = actions_};
}

ReplayableEpisode ReplayableEpisode::from(const SearchProblem& problem, const EpisodeHistory& history) {
  const search::World& world = problem.world();
  if (history.random.increment % 2 == 0) throw host::BadInput("not an episode of this search: its random numbers are none");
  ReplayableEpisode replayed;
  replayed.seed(Pcg32(history.random));
  if (!history.is_started) return replayed;
  if (!history.places) {
    replayed.start(problem);
  } else if (world.settings.domain.contains(history.places->position) && world.settings.domain.contains(history.places->source)) {
    replayed.start_at(problem, *history.places);
  } else {
    throw host::BadInput("not an episode of this search: it begins outside of the domain");
  }
  for (const char byte : history.actions) {
    const std::size_t action = static_cast<unsigned char>(byte);
    if (replayed.episode().record().end != search::EpisodeEnd::kRunning || action >= world.actions.size()) {
      throw host::BadInput("not an episode of this search: it takes steps that cannot be taken");
    }
    replayed.step(problem, action);
  }
  return replayed;
}

}  // namespace earshot::python
