#include "policy/command_line/outputs.hpp"

#include <array>
#include <map>

#include "firmware/host/file/bad_input.hpp"
#include "sim/plot/gnuplot.hpp"

namespace earshot::command_line {
namespace {

using host::BadInput;

/// One name for one file, whether it is there yet or not.
std::filesystem::path canonical_name(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path);
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

}  // namespace

void check_distinct(std::span<const Output> files) {
  std::map<std::filesystem::path, const Output*> known;
  for (const Output& file : files) {
    const auto [first, is_new] = known.emplace(canonical_name(file.path), &file);
    if (is_new) continue;
    const Output& other = *first->second;
    throw BadInput(other.option + " " + other.path.string() + ", " + file.option + " " + file.path.string() +
                   ": the same file, one would replace the other");
  }
}

void check_is_none_of(std::span<const Output> outputs, const std::string& option, const std::filesystem::path& read) {
  for (const Output& output : outputs) check_distinct(std::array{Output{option, read, {}}, output});
}

void require_writable(std::span<const Output> files, host::Replace replace) {
  check_distinct(files);
  for (const Output& file : files) host::require_writable(file.path, file.kind, replace);
}

void check_picture_name(const std::string& option, const std::filesystem::path& path) {
  if (!plot::is_picture_name(path)) throw BadInput(option + " " + path.string() + ": must end in .png or .svg");
}

}  // namespace earshot::command_line
