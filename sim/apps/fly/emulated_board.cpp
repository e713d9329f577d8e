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

}  // namespace

fs::path program_of_board(const std::string& name) {
  const std::string preset = name == kBoardSmall ? "cortex-m7" : "cortex-m7-full";
  try {
    return host::shipped("build/" + preset + "/bin/earshot-cortex-m7.elf");
  } catch (const host::BadInput& e) {
    throw host::BadInput(std::string(e.what()) + ": --board needs it: toolchains/build " + preset + " earshot-cortex-m7");
  }
}

EmulatedBoard::EmulatedBoard(const fs::path& program, std::uint64_t run, const fs::path& emulator)
    : line_(fs::temp_directory_path() / ("earshot-board-" + std::to_string(run))) {
  if (!fs::exists(emulator)) throw host::BadInput("--board: there is no " + emulator.string() + ": toolchains/setup cortex-m7");
  const std::vector<std::string> arguments{
      "-M",       "mps2-an500",   "-display", "none",
      "-monitor", "none",         "-chardev", "socket,id=line,path=" + line_.string() + ",server=on,wait=off",
      "-serial",  "chardev:line", "-kernel",  program.string()};
  emulator_ = std::make_unique<program::ChildProcess>(emulator.string(), arguments);
  constexpr milliseconds kPatience{20'000};
  constexpr milliseconds kLook{10};
  for (milliseconds waited{0}; !fs::exists(line_); waited += kLook) {
    emulator_->poll();
    if (!emulator_->running() || waited > kPatience) {
      emulator_->signal(SIGKILL);
      throw std::runtime_error(emulator.string() + " does not come up");
    }
    std::this_thread::sleep_for(kLook);
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
