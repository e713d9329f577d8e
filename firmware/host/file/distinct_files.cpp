#include "firmware/host/file/distinct_files.hpp"

#include <system_error>
#include <utility>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {
namespace {

std::filesystem::path canonical_name(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  return error ? path : canonical;
}

}  // namespace

bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code differ;
  return canonical_name(a) == canonical_name(b) || std::filesystem::equivalent(a, b, differ);
}

bool DistinctFiles::File::is(const File& other) const {
  std::error_code differ;
  return canonical == other.canonical || std::filesystem::equivalent(path, other.path, differ);
}

void DistinctFiles::read(const std::string& name, const std::filesystem::path& path) {
  const File& file = read_.emplace_back(File{name, path, canonical_name(path)});
  for (const File& written : written_)
    if (file.is(written)) refuse(file, written);
}

void DistinctFiles::read(const std::string& name, std::span<const std::filesystem::path> paths) {
  for (const std::filesystem::path& path : paths) read(name, path);
}

void DistinctFiles::write(const std::string& name, const std::filesystem::path& path) {
  const File& file = written_.emplace_back(File{name, path, canonical_name(followed(path))});
  for (const File& read : read_)
    if (file.is(read)) refuse(read, file);
  for (const File& earlier : std::span(written_).first(written_.size() - 1))
    if (file.is(earlier)) refuse(earlier, file);
}

void DistinctFiles::refuse(const File& first, const File& second) {
  throw BadInput(first.name + " " + first.path.string() + ", " + second.name + " " + second.path.string() +
                 ": the same file, one would replace the other");
}

void require_writable(DistinctFiles read, std::span<const Output> outputs, Replace replace) {
  for (const Output& output : outputs) read.write(output.name, output.path);
  for (const Output& output : outputs) require_writable(output.path, output.kind, replace);
}

}  // namespace earshot::host
