#include "firmware/host/mission/key_file.hpp"

#include <sodium.h>

#include <algorithm>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::host {

KeyBytes read_key_file(const std::filesystem::path& path, const char* kind) {
  const std::vector<std::uint8_t> text = read_bytes(path, kKeyFile);
  KeyBytes key{};
  std::size_t size = 0;
  const char* rest = nullptr;
  const auto* const begin = reinterpret_cast<const char*>(text.data());
  const int result = sodium_hex2bin(key.data(), key.size(), begin, text.size(), "", &size, &rest);
  const bool only_space_follows = result == 0 && std::all_of(rest, begin + text.size(), [](char c) { return c == '\n' || c == ' '; });
  if (!only_space_follows || size != key.size())
    throw BadInput(path.string() + ": must hold " + kind + " of 64 hexadecimal digits and nothing else");
  return key;
}

}  // namespace earshot::host
