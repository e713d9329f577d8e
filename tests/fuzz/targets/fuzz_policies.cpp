// `.policy` files with a checksum and a signature that hold, loaded and flown.
//
// The input: which good policy (1 byte), whether its golden trajectories are computed anew (1, odd), a row of changes to its bytes (see
// spoil()). Then the checksum is mended, and the file is signed.

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/fuzz/policy_flight.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::fuzz {

void judge(std::span<const std::uint8_t> input_bytes) {
  static const std::vector<Bytes> good = good_policies();
  static const host::TrustedKey trusted{.key = support::public_key(), .file = "a.pub"};
  static const auto runtime = std::make_unique<runtime::Runtime>();
  Input input(input_bytes);
  Bytes bytes = good[input.byte() % good.size()];
  const bool is_frozen_anew = input.byte() % 2 == 1;
  while (!input.is_used_up()) spoil(bytes, input);
  support::mend(bytes);
  if (is_frozen_anew) bytes = frozen_anew(bytes);
  try {
    const host::SignedPolicy loaded = host::signed_policy_from(std::move(bytes), "a.policy", trusted);
    host::require_repeats_golden(*loaded.policy, "a.policy");
    Pcg32 random(1);
    static_cast<void>(flies(*loaded.policy, *runtime, random));
  } catch (const host::BadInput& refusal) {
    require_names_file(refusal.what(), "a.policy: ");
  }
}

}  // namespace earshot::fuzz
