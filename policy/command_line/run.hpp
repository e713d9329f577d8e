#pragma once

#include <functional>

#include "firmware/host/program/command_line.hpp"
#include "sim/parallel/rank_session.hpp"

namespace earshot::command_line {

/// Parses the command line and runs `body`, as program::run does. A command line that is not UTF-8 is bad input too: provenance and JSON
/// could not hold it.
int run(program::CommandLine& line, int argc, char** argv, const std::function<void()>& body);

/// The same of a program that mpirun may have started: rank 0 alone speaks, and the session outlives what it says, because mpirun drops the
/// words of a rank when another has ended.
int run_ranked(program::CommandLine& line, int argc, char** argv, const std::function<void(parallel::RankSession&)>& body);

}  // namespace earshot::command_line
