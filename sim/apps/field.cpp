#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "sim/apps/field_arguments.hpp"
#include "sim/apps/field_modes.hpp"

namespace {

std::string command_line(int argc, char** argv) {
  std::string line = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

void run(const earshot::apps::FieldArguments& arguments) {
  require_consistent(arguments);
  if (arguments.radials > 0) {
    write_fan(arguments);
  } else {
    write_radial(arguments);
  }
}

}  // namespace

int main(int argc, char** argv) {
  earshot::apps::FieldArguments arguments;
  CLI::App app;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  arguments.history = command_line(argc, argv);
  try {
    run(arguments);
  } catch (const std::exception& e) {
    std::cerr << "earshot field: " << e.what() << '\n';
    return 2;
  }
  return 0;
}
