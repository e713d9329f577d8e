// The session of a program built without MPI.
#include <cstdlib>
#include <stdexcept>

#include "sim/parallel/ordered_tasks.hpp"
#include "sim/parallel/rank_session.hpp"

namespace earshot::parallel {

RankSession::RankSession() : ranks_(std::make_unique<Alone>()) {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {  // OpenMPI's; MPICH's and batch systems'
    const char* size = std::getenv(variable);                          // NOLINT(concurrency-mt-unsafe): before any thread
    if (size != nullptr && std::atoi(size) > 1) {
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
