#pragma once

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>

#include "firmware/config_file/table_reader.hpp"

namespace earshot::board {

/// Set when a person or a service manager asks the program to stop; see stop_on_signals().
inline volatile std::sig_atomic_t stop_requested = 0;

/// From now on SIGINT and SIGTERM set stop_requested and do nothing else.
inline void stop_on_signals() {
  std::signal(SIGINT, [](int) { stop_requested = 1; });
  std::signal(SIGTERM, [](int) { stop_requested = 1; });
}

/// What every program does around its work: the command line, and one clear line about bad input.
/// @param app  named like the program
/// @return exit status: `work`'s, 0 after --help, 2 when the command line or the input is refused
template <class Work>
int run_program(CLI::App& app, int argc, char** argv, Work work) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  try {
    return work();
  } catch (const config_file::BadInput& e) {
    std::cerr << e.what() << "\n";
  } catch (const std::exception& e) {
    std::cerr << app.get_name() << ": " << e.what() << "\n";
  }
  return 2;
}

}  // namespace earshot::board
