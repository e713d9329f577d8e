#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "sim/apps/field_arguments.hpp"
#include "sim/apps/field_modes.hpp"

namespace {

using earshot::apps::BadStart;
using earshot::apps::FieldArguments;
using earshot::parallel::RankSession;

std::string command_line(int argc, char** argv) {
  std::string line = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

void run(const FieldArguments& arguments, RankSession& session) {
  if (!arguments.library.empty()) {
    write_library(arguments, session);
  } else if (session.ranks().rank() == 0 && arguments.radials > 0) {
    write_fan(arguments);
  } else if (session.ranks().rank() == 0) {
    write_radial(arguments);
  }
}

int say(const std::exception& e) {
  std::cerr << "earshot field: " << e.what() << '\n';
  return 2;
}

int run_in_session(const FieldArguments& arguments) {
  RankSession session;
  try {
    run(arguments, session);
    return 0;
  } catch (const BadStart& e) {
    return session.ranks().rank() == 0 ? say(e) : 2;
  } catch (const std::exception& e) {
    const int status = say(e);
    if (session.ranks().size() > 1) session.abort();  // the others wait for us
    return status;
  }
}

}  // namespace

int main(int argc, char** argv) {
  FieldArguments arguments;
  CLI::App app;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  arguments.history = command_line(argc, argv);
  try {
    require_consistent(app, arguments);
    return run_in_session(arguments);
  } catch (const std::exception& e) {
    return say(e);
  }
}
