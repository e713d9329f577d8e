#include <algorithm>
#include <iostream>
#include <string>

#include "firmware/host/definitions/lcm_text.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/run.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  std::string type;
  program::CommandLine line("earshot lcm",
                            "Prints the messages that Earshot sends and takes over LCM, each as an .lcm file for lcm-gen:\n"
                            "earshot lcm nav_state_t > nav_state_t.lcm. Without a name it lists all.");
  line.option("type", &type, "the message's type");
  return program::run(line, argc, argv, [&type] {
    const std::vector<definitions::LcmDefinition> all = definitions::lcm_definitions();
    if (type.empty()) {
      for (const definitions::LcmDefinition& definition : all) std::cout << definition.type << '\n';
      return program::kDone;
    }
    const auto found = std::ranges::find(all, type, &definitions::LcmDefinition::type);
    if (found == all.end()) throw host::BadInput("there is no message " + host::printable(type) + "; earshot lcm lists all");
    std::cout << found->text;
    return program::kDone;
  });
}
