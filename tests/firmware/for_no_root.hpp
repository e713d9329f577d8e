#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace earshot::support {

/// A command whose process may write only what its owner, or group, or others may, though root runs the test.
struct ForNoRoot {
  ForNoRoot(const std::filesystem::path& wanted, std::vector<std::string> its_arguments)
      : program(wanted), arguments(std::move(its_arguments)) {
    if (geteuid() != 0) return;
    arguments.insert(arguments.begin(), {"--bounding-set=-dac_override,-dac_read_search", wanted.string()});
    program = "/usr/bin/setpriv";
  }

  std::filesystem::path program;
  std::vector<std::string> arguments;
};

}  // namespace earshot::support
