#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "hil/bench/bench_flight.hpp"
#include "hil/bench/case.hpp"
#include "hil/bench/verdict.hpp"

namespace earshot::hil {

/// What came of all cases, for the page and for JUnit (hil/page): JSON, lengths in metres, times in seconds since the flight began.
class Results {
 public:
  Results();
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// @param wrong  what is wrong with it, in words
  void add(const Case& c, const config::Mission& mission, const BenchFlight& flight, const JournalFindings& journal,
           const std::vector<std::string>& wrong);
  [[nodiscard]] std::size_t passed() const;
  [[nodiscard]] std::string text() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace earshot::hil
