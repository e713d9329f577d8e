#include "firmware/host/file/bad_input.hpp"

#include <cstddef>
#include <string_view>

#include "firmware/host/file/printable.hpp"

namespace earshot::host {
namespace {

// No screen holds more, and no person reads it.
constexpr std::size_t kLongestMessage_bytes = std::size_t{16} * 1024;

std::string told(std::string_view message) {
  const std::string_view kept = message.substr(0, kLongestMessage_bytes);
  std::string text = printable_lines(kept);
  if (kept.size() < message.size()) text += "... (" + std::to_string(message.size() - kept.size()) + " more bytes)";
  return text;
}

}  // namespace

BadInput::BadInput(const std::string& message) : std::runtime_error(told(message)) {}

}  // namespace earshot::host
