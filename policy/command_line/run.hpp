#pragma once

#include <functional>

#include "firmware/host/program/command_line.hpp"
#include "sim/parallel/rank_session.hpp"

namespace earshot::command_line {

/// Parses the command line and runs `body`, as program::run does. A command line that is not UTF-8 is bad input too: provenance and JSON
/// could not hold it.
int run(program::CommandLine& line, int argc, char** argv, const std::function<void()>& body);

/// Does the same for a program that mpirun may have started. Rank 0 alone prints, and the session outlives its output, because mpirun drops
/// the output of a rank when another has ended.
int run_ranked(program::CommandLine& line, int argc, char** argv, const std::function<void(parallel::RankSession&)>& body);

}  // namespace earshot::command_line
