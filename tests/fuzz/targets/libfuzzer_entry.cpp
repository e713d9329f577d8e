// What libFuzzer calls of a target.

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/fuzz/targets/fuzz_target.hpp"

namespace earshot::fuzz {

WithoutHeap::WithoutHeap() = default;
WithoutHeap::~WithoutHeap() = default;

}  // namespace earshot::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    earshot::fuzz::judge({data, size});
  } catch (const std::exception& violation) {
    std::fprintf(stderr, "%s\n", violation.what());
    std::abort();
  }
  return 0;
}
