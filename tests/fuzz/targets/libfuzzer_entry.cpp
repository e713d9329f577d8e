// What libFuzzer calls of a target.

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/fuzz/targets/fuzz_target.hpp"

namespace earshot::fuzz {

WithoutHeap::WithoutHeap() = default;
WithoutHeap::~WithoutHeap() = default;

}  // namespace earshot::fuzz

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// What a target makes once, such as a good journal, it makes before libFuzzer looks at the time that an input takes.
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  earshot::fuzz::judge({});
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    earshot::fuzz::judge({data, size});
  } catch (const std::exception& violation) {
    std::fprintf(stderr, "%s\n", violation.what());
    std::abort();
  }
  return 0;
}
