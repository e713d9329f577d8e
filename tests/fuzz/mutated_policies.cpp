// Mutates `.policy` files, mends their CRC-32, signs them with a key of its own, and lets the vehicle's own loader and runtime have them:
// each is refused in one line, or flown within the mission's limits. usage: mutated_policies COUNT [FIRST]   (each number is one file, the
// same on every machine)
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/fuzz/mutation.hpp"
#include "tests/fuzz/numbered_mutants.hpp"
#include "tests/fuzz/policy_flight.hpp"
#include "tests/support/signed_policy.hpp"

namespace {

using namespace earshot;
using fuzz::Bytes;

constexpr std::string_view kBegin = "a.policy: ";

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

class Run {
 public:
  void judge(std::uint64_t number) {
    Pcg32 random(number);
    Bytes bytes = fuzz::mutated(good_[random.next() % good_.size()], random);
    support::sign(bytes);
    if (random.next() % 4 != 0) bytes = fuzz::frozen_anew(bytes);
    try {
      const host::SignedPolicy loaded = host::signed_policy_from(std::move(bytes), "a.policy", trusted_);
      host::require_repeats_golden(*loaded.policy, "a.policy");
      ++counts_[fuzz::flies(*loaded.policy, *runtime_, random) ? "flown within limits"
                                                               : "taken, but its area has no room for its steps, or no tables of its size"];
    } catch (const host::BadInput& refusal) {
      const std::string message = refusal.what();
      require(message.starts_with(kBegin) && message.find('\n') == std::string::npos, "a refusal is no line that begins with its file");
      ++counts_[kind_of(message.substr(kBegin.size()))];
    }
  }

  void describe() const {
    for (const auto& [what, count] : counts_) std::cout << count << "  " << what << "\n";
  }

 private:
  /// Refusals of one kind have one line, whatever an unknown section or version is called.
  static std::string kind_of(std::string message) {
    for (const char* tail : {"is a section this program does not know", "is of a version this program does not know"})
      if (message.find(tail) != std::string::npos) return std::string("refused: a section ") + tail;
    if (message.find("of the .policy format") != std::string::npos) return "refused: is of another version of the format";
    return "refused: " + message;
  }

  std::vector<Bytes> good_ = fuzz::good_policies();
  host::TrustedKey trusted_{.key = support::public_key(), .file = "a.pub"};
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace

int main(int argc, char** argv) {
  return earshot::fuzz::judge_numbered(
      argc, argv, "mutated_policies",
      "changes good .policy files and lets a vehicle load and fly them: each must be refused in one line,\n"
      "or flown within the mission's limits.",
      "policy", [] { return Run(); });
}
