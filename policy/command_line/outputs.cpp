#include "policy/command_line/outputs.hpp"

#include <array>
#include <cstddef>
#include <system_error>

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

/// By name, or as the disk has it: a hard link is another name for one file.
bool are_one(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code differ;
  return canonical_name(a) == canonical_name(b) || std::filesystem::equivalent(a, b, differ);
}

}  // namespace

void check_distinct(std::span<const Output> files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t earlier = 0; earlier < i; ++earlier) {
      if (!are_one(files[earlier].path, files[i].path)) continue;
      throw BadInput(files[earlier].option + " " + files[earlier].path.string() + ", " + files[i].option + " " + files[i].path.string() +
                     ": the same file, one would replace the other");
    }
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
