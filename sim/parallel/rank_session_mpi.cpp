// The session of a program built with MPI.
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <thread>
#include <vector>

#include "sim/parallel/launcher.hpp"
#include "sim/parallel/ordered_tasks.hpp"
#include "sim/parallel/rank_session.hpp"

namespace earshot::parallel {
namespace {

/// MPI's own waiting keeps a processor busy that the solver could use.
void wait_for(MPI_Request& request) {
  for (int done = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && done == 0;)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

class MpiRanks : public Ranks {
 public:
  [[nodiscard]] std::size_t rank() const override {
    int value = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &value);
    return static_cast<std::size_t>(value);
  }
  [[nodiscard]] std::size_t size() const override {
    int value = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &value);
    return static_cast<std::size_t>(value);
  }
  void share(std::vector<std::int32_t>& values) override {
    auto count = static_cast<std::uint64_t>(values.size());
    MPI_Bcast(&count, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    values.resize(count);
    MPI_Bcast(values.data(), static_cast<int>(count), MPI_INT32_T, 0, MPI_COMM_WORLD);
  }
  void send(std::span<const float> values) override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Issend(values.data(), static_cast<int>(values.size()), MPI_FLOAT, 0, 0, MPI_COMM_WORLD, &request);
    wait_for(request);
  }
  void receive(std::size_t from, std::span<float> values) override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Irecv(values.data(), static_cast<int>(values.size()), MPI_FLOAT, static_cast<int>(from), 0, MPI_COMM_WORLD, &request);
    wait_for(request);
  }
  void gather_everywhere(std::span<const float> mine, std::span<float> all) override {
    const int count = static_cast<int>(mine.size());
    MPI_Allgather(mine.data(), count, MPI_FLOAT, all.data(), count, MPI_FLOAT, MPI_COMM_WORLD);
  }
  [[nodiscard]] std::vector<std::string> gather(const std::string& mine) override {
    const int length = static_cast<int>(mine.size());
    std::vector<int> lengths(rank() == 0 ? size() : 0);
    MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
    std::vector<int> begins(lengths.size());
    std::exclusive_scan(lengths.begin(), lengths.end(), begins.begin(), 0);
    std::string together(lengths.empty() ? 0 : static_cast<std::size_t>(begins.back() + lengths.back()), '\0');
    MPI_Gatherv(mine.data(), length, MPI_CHAR, together.data(), lengths.data(), begins.data(), MPI_CHAR, 0, MPI_COMM_WORLD);
    std::vector<std::string> all;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      all.push_back(together.substr(static_cast<std::size_t>(begins[i]), static_cast<std::size_t>(lengths[i])));
    }
    return all;
  }
};

/// Starting MPI takes a good part of a second: only where mpirun (OpenMPI, MPICH, a PMI of a batch system) has started us.
bool is_started_by_mpirun() {
  return std::ranges::any_of(kLauncherVariables, [](const LauncherVariable& variable) {
    return std::getenv(variable.name) != nullptr;  // NOLINT(concurrency-mt-unsafe)
  });
}

int count_ranks_here() {
  MPI_Comm here = MPI_COMM_NULL;
  int count = 1;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &count);
  MPI_Comm_free(&here);
  return count;
}

}  // namespace

RankSession::RankSession() {
  if (!is_started_by_mpirun()) {
    ranks_ = std::make_unique<Alone>();
    return;
  }
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);  // threads compute, the first one alone talks
  ranks_ = std::make_unique<MpiRanks>();
  ranks_here_ = static_cast<std::size_t>(count_ranks_here());
}

RankSession::~RankSession() {
  int started = 0;
  MPI_Initialized(&started);
  if (started == 0) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait_for(request);
  MPI_Finalize();
}

std::size_t RankSession::processors() const {
  const std::size_t allowed = available_processors();
  const bool bound = allowed < std::thread::hardware_concurrency();
  return bound ? allowed : std::max<std::size_t>(1, allowed / ranks_here_);
}

std::string RankSession::first_error(const std::string& mine) {
  if (ranks_->size() == 1) return mine;
  const int me = static_cast<int>(ranks_->rank());
  const int claim = mine.empty() ? static_cast<int>(ranks_->size()) : me;
  int first = 0;
  MPI_Allreduce(&claim, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == static_cast<int>(ranks_->size())) return "";
  auto length = static_cast<int>(mine.size());
  MPI_Bcast(&length, 1, MPI_INT, first, MPI_COMM_WORLD);
  std::string error = mine;
  error.resize(static_cast<std::size_t>(length));
  MPI_Bcast(error.data(), length, MPI_CHAR, first, MPI_COMM_WORLD);
  return error;
}

void RankSession::abort() {
  int started = 0;
  MPI_Initialized(&started);
  if (started != 0) MPI_Abort(MPI_COMM_WORLD, 2);
  std::exit(2);
}

}  // namespace earshot::parallel
