// The session of a program built without MPI.
#include <cstdlib>
#include <stdexcept>

#include "sim/parallel/launcher.hpp"
#include "sim/parallel/ordered_tasks.hpp"
#include "sim/parallel/rank_session.hpp"

namespace earshot::parallel {

RankSession::RankSession() : ranks_(std::make_unique<Alone>()) {
  for (const LauncherVariable& variable : kLauncherVariables) {
    const char* value = std::getenv(variable.name);  // NOLINT(concurrency-mt-unsafe): before any thread
    if (value != nullptr && std::atoi(value) >= variable.least_of_many) {
      throw std::runtime_error("started by mpirun, but built without MPI: install libopenmpi-dev and build again");
    }
  }
}

RankSession::~RankSession() = default;

std::size_t RankSession::processors() const {
  return available_processors();
}

std::string RankSession::first_error(const std::string& mine) {
  return mine;
}

void RankSession::abort() {
  std::exit(2);
}

}  // namespace earshot::parallel
