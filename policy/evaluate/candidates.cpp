#include "policy/evaluate/candidates.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "policy/baselines/catalogue.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/search/scenario/file_kind.hpp"

namespace earshot::evaluate {
namespace {

using host::BadInput;

constexpr std::array<std::string_view, 2> kShipped = {"shipped", "fixed_source"};  ///< in policy/frozen

/// The first learned candidate; null when there is none.
const Candidate* first_learned(std::span<const Candidate> candidates) {
  for (const Candidate& c : candidates) {
    if (c.learned) return &c;
  }
  return nullptr;
}

bool is_given_the_ocean(std::string_view baseline) {
  const auto entry = std::ranges::find(baselines::catalogue(), baseline, &baselines::Entry::name);
  return entry != baselines::catalogue().end() && entry->is_given_the_ocean;
}

bool are_of_one_search(const policy::FrozenPolicy& a, const policy::FrozenPolicy& b) {
  return a.step_length == b.step_length && a.area_size == b.area_size && a.detection_threshold == b.detection_threshold;
}

bool are_one(const Candidate& a, const Candidate& b) {
  std::error_code differ;
  return a.name == b.name || (a.learned && b.learned && std::filesystem::equivalent(a.file, b.file, differ));
}

}  // namespace

std::vector<std::string> leave_out_repeated(std::vector<Candidate>& candidates) {
  std::vector<Candidate> each;
  std::vector<std::string> sentences;
  for (Candidate& candidate : candidates) {
    const auto first = std::ranges::find_if(each, [&candidate](const Candidate& c) { return are_one(c, candidate); });
    if (first == each.end()) {
      each.push_back(std::move(candidate));
      continue;
    }
    sentences.push_back(candidate.name +
                        (candidate.name == first->name ? ": named twice, flies once" : ": is " + first->name + ", flies once"));
  }
  candidates = std::move(each);
  return sentences;
}

Candidate candidate_named(const std::string& name) {
  for (const baselines::Entry& entry : baselines::catalogue()) {
    if (entry.name == name) return {.name = name, .learned = nullptr};
  }
  const std::filesystem::path world = shipped_world(name);
  if (!world.empty()) throw BadInput("POLICY " + name + ": is a world, not a policy: --world " + world.string());
  if (search::kind_of(name) != search::FileKind::kOther)
    throw BadInput("POLICY " + name +
                   ": is no policy (.policy): environments go with --environment, worlds with --world, missions with --mission");
  const bool is_shipped = std::ranges::find(kShipped, name) != kShipped.end();
  if (!is_shipped && name.find_first_of("./") == std::string::npos) {
    std::string known;
    for (const std::string_view ships : kShipped) known += std::string(ships) + ", ";
    for (const baselines::Entry& entry : baselines::catalogue()) known += std::string(entry.name) + ", ";
    known.resize(known.size() - 2);
    throw BadInput("--policies: " + name + ": neither a .policy file nor one of " + known);
  }
  std::filesystem::path file = is_shipped ? host::shipped("policy/frozen/" + name + ".policy") : std::filesystem::path(name);
  return {.name = name, .learned = host::load_unverified_policy(file), .file = file};
}

search::SearchSettings settings_of(std::span<const Candidate> candidates) {
  const Candidate* const first = first_learned(candidates);
  if (first == nullptr) return {};
  for (const Candidate& c : candidates) {
    if (c.learned && !are_of_one_search(*c.learned, *first->learned))
      throw BadInput(c.name + ": was trained for another area, step length or detection threshold than " + first->name +
                     ": evaluate them one by one");
  }
  return search_of(*first->learned);
}

void check_same_listening(std::span<const Candidate> candidates) {
  const Candidate* const first = first_learned(candidates);
  for (const Candidate& c : candidates) {
    if (c.learned && c.learned->observation.listening != first->learned->observation.listening)
      throw BadInput(c.name + ": listens over another window than " + first->name +
                     ": evaluate them one by one, or give both the same window (--listening)");
  }
}

std::string given_oceans(std::span<const Candidate> candidates, const std::filesystem::path& environment, bool is_true) {
  std::string names;
  for (const Candidate& candidate : candidates) {
    if (candidate.learned == nullptr && is_given_the_ocean(candidate.name)) names += (names.empty() ? "" : ", ") + candidate.name;
  }
  if (names.empty()) return "";
  return names + (is_true
                      ? ": given the true ocean, which a vehicle does not know\n"
                      : ": given the ocean of " + host::printable(environment.filename().string()) + ", in whichever world they search\n");
}

}  // namespace earshot::evaluate
