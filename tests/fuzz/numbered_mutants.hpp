#pragma once

#include <cstdint>
#include <exception>
#include <iostream>
#include <string>

#include "firmware/host/program/run.hpp"

namespace earshot::fuzz {

/// The main function of a program that judges mutants by their numbers: PROGRAM COUNT [FIRST].
/// @param does  what it does with them, for --help
/// @param noun  what a mutant is, for the message that names its number
/// @param make  a run: its judge(number) throws where the mutant does what none may, its describe() says at the end what became of all
/// @return exit status: 0, 1 at the first violation, 2 without a count or for what is no number
template <class Make>
int judge_numbered(int argc, char** argv, const std::string& program, const std::string& does, const std::string& noun, Make make) {
  constexpr std::int64_t kMost = 1'000'000'000'000;
  std::uint64_t count = 0;
  std::uint64_t first = 0;
  program::CommandLine line(program, program + " " + does + "\nExit status: 0 all were; 1 one was not, and standard error says which.");
  line.option("COUNT", &count, "how many are tried").required().from(1, kMost);
  line.option("FIRST", &first, "the number of the first; each makes one " + noun).from(0, kMost).shows_default();
  return program::run(line, argc, argv, [&] {
    auto run = make();
    for (std::uint64_t number = first; number < first + count; ++number) {
      try {
        run.judge(number);
      } catch (const std::exception& violation) {
        std::cerr << noun << " " << number << ": " << violation.what() << "\n";
        return 1;
      }
    }
    run.describe();
    return 0;
  });
}

}  // namespace earshot::fuzz
