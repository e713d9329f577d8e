#include "policy/command_line/run.hpp"

#include <iostream>
#include <stdexcept>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/run.hpp"

namespace earshot::command_line {
namespace {

void check_encoding(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (!host::is_utf8(argv[i])) throw host::BadInput("the command line holds bytes that are not UTF-8");
  }
}

}  // namespace

int run(program::CommandLine& line, int argc, char** argv, const std::function<void()>& body) {
  return program::run(line, argc, argv, [&] {
    check_encoding(argc, argv);
    body();
    return program::kDone;
  });
}

int run_ranked(program::CommandLine& line, int argc, char** argv, const std::function<void(parallel::RankSession&)>& body) {
  try {
    parallel::RankSession session;
    if (session.ranks().rank() != 0) {
      std::cerr.rdbuf(nullptr);
      std::cout.rdbuf(nullptr);
    }
    return run(line, argc, argv, [&] { body(session); });
  } catch (const std::runtime_error& e) {
    std::cerr << line.name() << ": " << e.what() << "\n";
    return program::kBadInput;
  }
}

}  // namespace earshot::command_line
