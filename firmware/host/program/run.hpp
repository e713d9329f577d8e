#pragma once

#include <functional>

#include "firmware/host/program/command_line.hpp"
#include "firmware/host/program/exit_status.hpp"

namespace earshot::program {

/// What every program does around its work: opens the standard streams that are closed, reads the command line, answers --help and
/// --version, obeys --quiet and --verbose, and turns bad input into one message on standard error.
/// @param work  gives the exit status
/// @return work's status; kDone after --help and --version; kBadInput when the command line or the input is refused; kLost when what was to
///         be printed could not be
int run(CommandLine& line, int argc, char** argv, const std::function<int()>& work);

}  // namespace earshot::program
