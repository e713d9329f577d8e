#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <string>

#include "sim/parallel/ranks.hpp"

namespace earshot::parallel {

/// The part this process has among those that `mpirun` has started; one process alone where it was started without. Programs built without
/// MPI refuse to be started by mpirun, where each would write the same file.
class RankSession {
 public:
  RankSession();   ///< throws std::runtime_error when MPI cannot be had but is needed
  ~RankSession();  ///< waits for all ranks
  RankSession(const RankSession&) = delete;
  RankSession& operator=(const RankSession&) = delete;

  [[nodiscard]] Ranks& ranks() { return *ranks_; }

  /// Processors for the threads of this rank: those it is bound to, or its share of the machine's.
  [[nodiscard]] std::size_t processors() const;

  /// The first rank's error that is not empty, on every rank.
  [[nodiscard]] std::string first_error(const std::string& mine);

  /// Runs `work`, on every rank; where it throws `Caught` on any, throws an `Error` with the words of the first such rank on all of them,
  /// so that none goes on and waits for one that has given up.
  template <class Error, class Caught = Error, class Work>
  void all_or_none(Work work) {
    std::string error;
    try {
      work();
    } catch (const Caught& e) {
      error = e.what();
    }
    error = first_error(error);
    if (!error.empty()) throw Error(error);
  }

  /// Ends every rank with exit status 2.
  [[noreturn]] void abort();

 private:
  std::unique_ptr<Ranks> ranks_;
  std::size_t ranks_here_ = 1;  ///< on this machine
};

}  // namespace earshot::parallel
