// fuzz_TARGET FILE...: tries the inputs of a corpus (a .txt: one input a line, in hexadecimal) and files that are an input each.

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/memory/heap_trap.hpp"
#include "firmware/host/program/run.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"

namespace earshot::fuzz {

WithoutHeap::WithoutHeap() {
  host::arm_heap_trap();
}

WithoutHeap::~WithoutHeap() {
  host::disarm_heap_trap();
  if (host::heap_uses().empty()) return;
  std::cerr << "memory was asked for: " << host::to_string(host::heap_uses().front()) << std::endl;
  std::abort();
}

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes from_hexadecimal(const std::string& line, const std::string& path) {
  if (line.size() % 2 != 0 || line.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw host::BadInput(path + ": a line is no row of bytes in hexadecimal");
  Bytes bytes;
  for (std::size_t i = 0; i < line.size(); i += 2) bytes.push_back(static_cast<std::uint8_t>(std::stoul(line.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::vector<Bytes> inputs_in(const std::string& path) {
  if (!path.ends_with(".txt")) return {host::read_bytes(path, host::kAnySize)};
  std::istringstream lines(host::read_text(path, host::kAnySize));
  std::vector<Bytes> inputs;
  for (std::string line; std::getline(lines, line);) inputs.push_back(from_hexadecimal(line, path));
  return inputs;
}

int replay(const std::vector<std::string>& paths) {
  std::size_t count = 0;
  for (const std::string& path : paths) {
    for (const Bytes& input : inputs_in(path)) {
      try {
        judge(input);
      } catch (const std::logic_error& violation) {
        std::cerr << path << ": input " << count << ": " << violation.what() << "\n";
        return 1;
      }
      ++count;
    }
  }
  std::cout << count << " inputs, nothing came of them that must not\n";
  return count > 0 ? 0 : 1;
}

}  // namespace
}  // namespace earshot::fuzz

int main(int argc, char** argv) {
  std::vector<std::string> paths;
  earshot::program::CommandLine line("fuzz_TARGET",
                                     "fuzz_TARGET tries the inputs of a corpus, and files that are an input each.\n"
                                     "Exit status: 0 nothing came of them that must not; 1 something did, and standard error says which.");
  line.option("FILE", &paths, "a corpus (.txt, one input a line in hexadecimal), or one input as it is").required();
  return earshot::program::run(line, argc, argv, [&] { return earshot::fuzz::replay(paths); });
}
