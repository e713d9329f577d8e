#include "firmware/host/file/process.hpp"

#include <csignal>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <system_error>

namespace earshot::host {
namespace {

constexpr std::uint64_t kKilled = std::uint64_t{1} << (SIGKILL - 1);  // of a set of signals as the kernel prints it

bool is_thread_killed(const std::filesystem::path& status) {
  std::ifstream lines(status);
  bool has_name = false, has_memory = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    has_name = has_name || key == "Name:";
    has_memory = has_memory || key == "VmSize:";
    std::uint64_t pending = 0;
    if ((key == "SigPnd:" || key == "ShdPnd:") && words >> std::hex >> pending && (pending & kKilled) != 0) return true;
  }
  return has_name && !has_memory;
}

}  // namespace

std::string name_of_process(const std::string& number) {
  std::string name = "a program";
  std::ifstream comm("/proc/" + number + "/comm");
  std::getline(comm, name);
  return name + " (process " + number + ")";
}

bool is_killed(const std::filesystem::path& process) {
  std::error_code error;
  bool is_any_there = false;
  for (std::filesystem::directory_iterator thread(process / "task", error), end; !error && thread != end; thread.increment(error)) {
    if (!is_thread_killed(thread->path() / "status")) return false;
    is_any_there = true;
  }
  return !error && is_any_there;
}

}  // namespace earshot::host
