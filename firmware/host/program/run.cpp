#include "firmware/host/program/run.hpp"

#include <chrono>
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/standard_streams.hpp"
#include "firmware/host/program/talk.hpp"

namespace earshot::program {
namespace {

/// A process that is not to speak has no buffer there.
bool is_all_printed() {
  return std::cout.rdbuf() == nullptr || std::cout.flush().good();
}

}  // namespace

int run(CommandLine& line, int argc, char** argv, const std::function<int()>& work) {
  open_standard_streams();
  host::remove_unfinished_on_signals();
  (void)std::signal(SIGXFSZ, SIG_IGN);  // a file over its limit is a full disk: write(2) says so, and nothing is ended in the middle
  try {
    if (const std::optional<std::string> answer = line.read(argc, argv)) {
      std::cout << *answer;
    } else {
      set_talk(line.talk());
      detail() << version_line(line.name()) << "\n" << line.settings();
      const auto began = std::chrono::steady_clock::now();
      const int status = work();
      detail() << line.name() << ": took " << std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() << " s\n";
      if (status != kDone) return status;
    }
    if (is_all_printed()) return kDone;
    std::cerr << line.name() << ": standard output cannot be written\n";
    return kLost;
  } catch (const host::BadInput& e) {
    std::cerr << host::printable_lines(e.what()) << "\n";
  } catch (const std::filesystem::filesystem_error& e) {
    const std::string path = e.path1().empty() ? std::string("a file or folder without a name") : host::printable(e.path1().string());
    std::cerr << path << ": cannot be read or written: " << e.code().message() << "\n";
  } catch (const std::bad_alloc&) {
    std::cerr << line.name() << ": not enough memory for what was asked\n";
  } catch (const std::exception& e) {
    std::cerr << line.name() << ": " << host::printable_lines(e.what()) << "\n";
  }
  return kBadInput;
}

}  // namespace earshot::program
