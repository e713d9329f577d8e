#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "policy/evaluate/candidates.hpp"

namespace earshot::evaluate {

/// A learned candidate with a network, of the paper's area, step and threshold.
inline Candidate learned(const std::string& name, std::string_view provenance) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->step_length = Meters{1'000.0};
  policy->area_size = {Meters{25'000.0}, Meters{25'000.0}};
  policy->detection_threshold = Decibels{10.0};
  policy->network.hidden_sizes = {4, 4};
  for (const char letter : provenance) EXPECT_EQ(policy->provenance.push_back(letter), Status::kOk);
  return {name, std::move(policy)};
}

/// An oracle, then the two.
inline std::vector<Candidate> both(Candidate a, Candidate b) {
  std::vector<Candidate> candidates;
  candidates.push_back({"oracle", nullptr});
  candidates.push_back(std::move(a));
  candidates.push_back(std::move(b));
  return candidates;
}

}  // namespace earshot::evaluate
