#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "firmware/host/program/run.hpp"
#include "sim/apps/field/arguments.hpp"
#include "sim/apps/field/modes.hpp"

namespace {

using earshot::field::BadStart;
using earshot::field::FieldArguments;
using earshot::field::option_of;
using earshot::parallel::RankSession;
using earshot::program::CommandLine;

void run(const FieldArguments& arguments, RankSession& session) {
  if (!arguments.library.empty()) {
    write_library(arguments, session);
  } else if (session.ranks().rank() == 0 && arguments.radials > 0) {
    write_fan(arguments);
  } else if (session.ranks().rank() == 0) {
    write_radial(arguments);
  }
}

int report(const std::exception& e) {
  std::cerr << "earshot field: " << e.what() << '\n';
  return 2;
}

int run_in_session(const FieldArguments& arguments) {
  RankSession session;
  try {
    run(arguments, session);
    return 0;
  } catch (const earshot::sonar::BadRequest& bad) {
    std::cerr << "earshot field: " << bad.called(option_of(bad.what_is_wrong())) << '\n';
    return 2;
  } catch (const BadStart& e) {
    return session.ranks().rank() == 0 ? report(e) : 2;
  } catch (const std::exception& e) {
    const int status = report(e);
    if (session.ranks().size() > 1) session.abort();  // the others wait for us
    return status;
  }
}

}  // namespace

int main(int argc, char** argv) {
  FieldArguments arguments;
  CommandLine line(
      "earshot field",
      "Computes how loud the source of an ocean is at every range and depth, and writes transmission loss and SNR as NetCDF (CF-1.11):\n"
      "along one bearing, all around (--radials), or for many sources of a region (--library).");
  describe(line, arguments);
  return earshot::program::run(line, argc, argv, [&] {
    arguments.history = earshot::program::as_typed(argc, argv);
    require_consistent(line, arguments);
    return run_in_session(arguments);
  });
}
