// earshot VERB [ARGUMENT...]: executes the program earshot-VERB that stands beside this one, as git does.

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
constexpr std::string_view kPrefix = "earshot-";

fs::path own_folder() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

std::vector<std::string> verbs(const fs::path& folder) {
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(kPrefix) && access(entry.path().c_str(), X_OK) == 0) found.push_back(name.substr(kPrefix.size()));
  }
  std::sort(found.begin(), found.end());
  return found;
}

void print_help(std::ostream& out, const fs::path& folder) {
  out << "usage: earshot VERB [ARGUMENT...]\n\nVerbs installed here (earshot VERB --help says more):\n";
  for (const std::string& verb : verbs(folder)) out << "  " << verb << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path folder = own_folder();
  const std::string_view verb = argc > 1 ? argv[1] : "help";
  if (verb == "help" || verb == "--help" || verb == "-h") {
    print_help(std::cout, folder);
    return 0;
  }
  const std::string program = folder / (std::string(kPrefix) + std::string(verb));
  if (verb.find('/') == std::string_view::npos) execv(program.c_str(), argv + 1);
  if (errno == ENOENT || verb.find('/') != std::string_view::npos) {
    std::cerr << "earshot: there is no verb \"" << verb << "\"; see earshot help\n";
  } else {
    std::cerr << program << ": " << std::strerror(errno) << "\n";
  }
  return 2;
}
