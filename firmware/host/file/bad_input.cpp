#include "firmware/host/file/bad_input.hpp"

#include <cstddef>
#include <string_view>

#include "firmware/host/file/printable.hpp"

namespace earshot::host {
namespace {

// No screen holds more, and no person reads it.
constexpr std::size_t kLongestMessage_bytes = std::size_t{16} * 1024;
// Our own words are shorter; a name or a value of somebody's file may have as many as that.
constexpr std::size_t kLongestLine_bytes = 1000;

std::string with_short_lines(std::string_view message) {
  std::string text;
  for (std::size_t end = message.find('\n'); end != std::string_view::npos; end = message.find('\n')) {
    text += shortened(message.substr(0, end), kLongestLine_bytes) + "\n";
    message.remove_prefix(end + 1);
  }
  return text + shortened(message, kLongestLine_bytes);
}

std::string shortened_message(std::string_view whole) {
  const std::string message = with_short_lines(whole);
  const std::string_view kept = std::string_view(message).substr(0, kLongestMessage_bytes);
  std::string text = printable_lines(kept);
  if (kept.size() < message.size()) text += "... (" + std::to_string(message.size() - kept.size()) + " more bytes)";
  return text;
}

}  // namespace

BadInput::BadInput(const std::string& message) : std::runtime_error(shortened_message(message)) {}

}  // namespace earshot::host
