// earshot VERB [ARGUMENT...]: executes the program earshot-VERB that stands beside this one, as git does.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/program/command_line.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/suggestion.hpp"

namespace {

namespace fs = std::filesystem;
constexpr std::string_view kPrefix = "earshot-";

std::vector<std::string> verbs(const fs::path& folder) {
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(kPrefix) && access(entry.path().c_str(), X_OK) == 0) found.push_back(name.substr(kPrefix.size()));
  }
  std::sort(found.begin(), found.end());
  return found;
}

struct Description {
  std::string_view package;
  std::string_view verb;
  std::string_view what;
};

/// Of the verbs that are ours, by the package that brings them; another program that somebody put beside them has none.
constexpr std::array kDescriptions{
    Description{"earshot", "journal", "prints what happened on a mission, and writes its journal for other programs"},
    Description{"earshot", "key", "makes a pair of keys, with which missions and policies are signed"},
    Description{"earshot", "sign", "signs a mission for vehicles that fly signed ones alone"},
    Description{"earshot", "verify", "checks whether a vehicle would fly a mission or a policy, who signed it, and which counter it bears"},
    Description{"earshot-sil", "fly", "flies one search, from start to report"},
    Description{"earshot-sil", "init", "makes a folder with a mission and an ocean of your own"},
    Description{"earshot-sil", "replay", "gives a journal to the vehicle's core again, also with another policy or mission"},
    Description{"earshot-sil", "report", "writes the page about a flight again"},
    Description{"earshot-sil", "sim", "the ocean and the vehicle of a flight; earshot fly starts it"},
    Description{"earshot-sil", "watch", "shows a flight in a browser, while it is flown and afterwards"},
    Description{"earshot-tools", "candump", "prints in words what goes over a CAN bus, and records it"},
    Description{"earshot-tools", "dbc", "prints the CAN messages as a DBC file"},
    Description{"earshot-tools", "evaluate", "flies many searches with policies and baselines, and reports how they did"},
    Description{"earshot-tools", "explain", "draws what a policy does, and explains why it took one decision of a flight"},
    Description{"earshot-tools", "field", "computes how loud a source is at every range and depth (NetCDF)"},
    Description{"earshot-tools", "freeze", "freezes and signs a trained policy for the vehicle"},
    Description{"earshot-tools", "lcm", "prints the LCM messages as .lcm files"},
    Description{"earshot-tools", "listen", "hears calls in recordings with the vehicle's detector"},
    Description{"earshot-tools", "tables", "makes the tables of what a vehicle believes possible of the ocean, and shows them"},
    Description{"earshot-tools", "train", "trains a policy"},
    Description{"earshot-hil", "bench", "flies cases of the bench on a bus; earshot hil starts it"},
    Description{"earshot-hil", "emulate", "a vehicle's devices on a CAN bus, for an earshotd without its vehicle"},
    Description{"earshot-hil", "hil", "flies missions with faults on a bench, and reports which went as they had to"},
    Description{"earshot-hil", "with-can", "runs a command where SocketCAN works, on any machine"},
};

std::string_view package_of(std::string_view verb) {
  const auto* const found = std::ranges::find(kDescriptions, verb, &Description::verb);
  return found == kDescriptions.end() ? std::string_view() : found->package;
}

void print_verb(std::ostream& out, std::string_view verb, std::string_view what) {
  constexpr int kColumn = 12;
  out << "  " << std::left << std::setw(kColumn) << verb << what << "\n";
}

/// What a stranger reads first: of packages, or of the source tree. Empty when neither is there.
fs::path first_page(const fs::path& folder) {
  for (const char* page : {"../share/doc/earshot/README.Debian", "../../../README.md"}) {
    std::error_code error;
    fs::path path = (folder / page).lexically_normal();
    if (fs::exists(path, error)) return path;
  }
  return {};
}

/// Verbs that are a script of the source tree, and no program that is built: where it stands there.
constexpr std::array<std::pair<std::string_view, const char*>, 2> kScripts{{{"hil", "hil/run"}, {"with-can", "hil/bus/with-can"}}};

/// The script of the source tree that this program was built in; empty: it is another verb, or no source tree.
fs::path script_of(std::string_view verb, const fs::path& folder) {
  for (const auto& [name, script] : kScripts) {
    const fs::path path = (folder / "../../.." / script).lexically_normal();
    std::error_code error;
    if (name == verb && fs::exists(path, error)) return path;
  }
  return {};
}

/// All that there are, so that the manual page is the same whatever is installed; a verb that is not here says what brings it.
void print_help(std::ostream& out, const fs::path& folder) {
  out << "Usage: earshot VERB [ARGUMENT...]\n  or:  earshot help VERB\n  or:  earshot --version\n\nVerbs, and the package that brings "
         "them.\n";
  std::string_view package;
  for (const Description& described : kDescriptions) {
    if (described.package != package) out << "\nPackage " << described.package << ":\n";
    package = described.package;
    print_verb(out, described.verb, described.what);
  }
  std::string_view heading = "\nOther programs here:\n";
  for (const std::string& verb : verbs(folder)) {
    if (!package_of(verb).empty()) continue;
    out << std::exchange(heading, "");
    print_verb(out, verb, "");
  }
  if (!script_of("hil", folder).empty()) out << "\nIn a source tree hil/run is earshot hil, and hil/bus/with-can is earshot with-can.\n";
  if (const fs::path page = first_page(folder); !page.empty()) out << "\nWhere to begin: " << page.string() << "\n";
}

/// Becomes the verb's program; comes back only when that cannot be.
int execute(const fs::path& folder, const std::string& verb, std::vector<char*> arguments) {
  const std::string program = folder / (std::string(kPrefix) + verb);
  const bool is_name = verb.find('/') == std::string::npos;
  if (is_name) execv(program.c_str(), arguments.data());
  if (is_name && errno != ENOENT) {
    std::cerr << program << ": " << std::strerror(errno) << "\n";
  } else {
    // One of Earshot's that this computer has not got: the packages share them out.
    const std::string package(package_of(verb));
    const fs::path script = script_of(verb, folder);
    if (!script.empty()) {
      std::cerr << "earshot: in a source tree " << verb << " is " << script.string() << "\n";
      return earshot::program::kBadInput;
    }
    std::cerr << "earshot: there is no verb \"" << earshot::host::printable(verb) << "\""
              << (package.empty() ? earshot::program::did_you_mean(verb, verbs(folder))
                                  : " here: the package " + package + " brings it (apt install ./" + package + "_*.deb)")
              << " (earshot help lists all)\n";
  }
  return earshot::program::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path folder = earshot::host::own_folder();
  std::string verb = argc > 1 ? argv[1] : "help";
  std::vector<char*> arguments(argv + std::min(argc, 1), argv + argc);
  arguments.push_back(nullptr);
  if (verb == "--version") {
    std::cout << earshot::program::version_line("earshot") << "\n";
    return earshot::program::kDone;
  }
  const bool asks_for_help = verb == "help" || verb == "--help" || verb == "-h";
  if (asks_for_help && argc < 3) {
    print_help(std::cout, folder);
    return earshot::program::kDone;
  }
  if (asks_for_help) {
    verb = argv[2];
    std::string help = "--help";
    return execute(folder, verb, {argv[2], help.data(), nullptr});
  }
  return execute(folder, verb, arguments);
}
