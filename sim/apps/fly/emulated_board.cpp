#include "sim/apps/fly/emulated_board.hpp"

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/shipped.hpp"

namespace earshot::fly {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// A path for the socket that stands in for the serial line. @throws host::BadInput naming TMPDIR
fs::path path_of_line(std::uint64_t run) {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (error) throw host::BadInput("--board: TMPDIR is no folder: " + error.message());
  return folder / ("earshot-board-" + std::to_string(run));
}

/// As QEMU wants a path within an argument that has several parts.
std::string with_commas_doubled(const std::string& text) {
  std::string doubled;
  for (const char c : text) doubled += c == ',' ? std::string(2, c) : std::string(1, c);
  return doubled;
}

}  // namespace

fs::path program_of_board(const std::string& name) {
  const std::string preset = name == kBoardSmall ? "cortex-m7" : "cortex-m7-full";
  try {
    return host::shipped("build/" + preset + "/bin/earshot-cortex-m7.elf");
  } catch (const host::BadInput& e) {
    throw host::BadInput(std::string(e.what()) + ": --board needs it: toolchains/build " + preset + " earshot-cortex-m7");
  }
}

EmulatedBoard::EmulatedBoard(const fs::path& program, std::uint64_t run, const fs::path& emulator) : line_(path_of_line(run)) {
  if (!fs::exists(emulator)) throw host::BadInput("--board: there is no " + emulator.string() + ": toolchains/setup cortex-m7");
  const std::vector<std::string> arguments{
      "-M",       "mps2-an500",   "-display", "none",
      "-monitor", "none",         "-chardev", "socket,id=line,path=" + with_commas_doubled(line_.string()) + ",server=on,wait=off",
      "-serial",  "chardev:line", "-kernel",  program.string()};
  emulator_ = std::make_unique<program::ChildProcess>(emulator.string(), arguments);
  constexpr milliseconds kPatience{20'000};
  constexpr milliseconds kPollInterval{10};
  for (milliseconds waited{0}; !fs::exists(line_); waited += kPollInterval) {
    emulator_->poll();
    if (!emulator_->running())
      throw std::runtime_error(emulator.string() + " does not come up: it ended with status " + std::to_string(emulator_->status()) +
                               " before it had opened " + line_.string() + " (TMPDIR)");
    if (waited > kPatience) {
      emulator_->signal(SIGKILL);
      throw std::runtime_error(emulator.string() + " does not come up: after 20 s there is no " + line_.string());
    }
    std::this_thread::sleep_for(kPollInterval);
  }
}

EmulatedBoard::~EmulatedBoard() {
  emulator_->signal(SIGKILL);  // there is nothing that it would lose
  while (emulator_->running()) {
    emulator_->poll();
    std::this_thread::sleep_for(milliseconds(1));
  }
  std::error_code ignored;
  fs::remove(line_, ignored);
}

}  // namespace earshot::fly
