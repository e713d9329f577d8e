#pragma once

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>

namespace earshot::fuzz {

/// The main function of a program that judges mutants by their numbers: PROGRAM COUNT [FIRST].
/// @param make  a run: its judge(number) throws where the mutant does what none may, its tell() says at the end what became of all
/// @param noun  what a mutant is, for the message that names its number
/// @return exit status: 0, 1 at the first violation, 2 without a count
template <class Make>
int judge_numbered(int argc, char** argv, const char* program, const char* noun, Make make) {
  const std::uint64_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 0;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  if (count == 0) {
    std::cerr << "usage: " << program << " COUNT [FIRST]\n";
    return 2;
  }
  auto run = make();
  for (std::uint64_t number = first; number < first + count; ++number) {
    try {
      run.judge(number);
    } catch (const std::exception& violation) {
      std::cerr << noun << " " << number << ": " << violation.what() << "\n";
      return 1;
    }
  }
  run.tell();
  return 0;
}

}  // namespace earshot::fuzz
