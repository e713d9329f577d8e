#include "firmware/boards/cortex_m7/stack.hpp"

#include <cstdint>

extern "C" {
extern std::uint32_t start_of_stack;  // of the linker script; the stack grows down to it
extern std::uint32_t end_of_stack;
}

namespace earshot::stack {
namespace {

constexpr std::uint32_t kPaint = 0xA5C3'5A3CU;

}  // namespace

void paint() {
  std::uint32_t* top = nullptr;
  asm volatile("mov %0, sp" : "=r"(top));
  for (std::uint32_t* word = &start_of_stack; word < top; ++word) *const_cast<volatile std::uint32_t*>(word) = kPaint;
}

std::size_t most_used() {
  const std::uint32_t* word = &start_of_stack;
  while (word < &end_of_stack && *word == kPaint) ++word;
  return static_cast<std::size_t>(&end_of_stack - word) * sizeof(std::uint32_t);
}

std::size_t size() {
  return static_cast<std::size_t>(&end_of_stack - &start_of_stack) * sizeof(std::uint32_t);
}

}  // namespace earshot::stack
