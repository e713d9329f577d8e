#include "tests/policy/freeze/bytes.hpp"

#include <zip.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "policy/freeze/zip_archive.hpp"

namespace earshot::freeze::test {

std::string model(const std::string& name) {
  std::ifstream stream(EARSHOT_SOURCE_DIR "/tests/policy/freeze/models/" + name, std::ios::binary);
  if (!stream) throw std::runtime_error("no model " + name);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

nlohmann::json model_oracle() {
  return nlohmann::json::parse(model("memory.json"));
}

std::string zip_of(const std::map<std::string, std::string>& entries) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(target);
  zip_t* archive = zip_open_from_source(target, ZIP_TRUNCATE, &error);
  for (const auto& [name, content] : entries) {
    const zip_int64_t index = zip_file_add(archive, name.c_str(), zip_source_buffer(archive, content.data(), content.size(), 0), 0);
    if (index < 0) throw std::runtime_error("zip_file_add");
  }
  if (zip_close(archive) != 0) throw std::runtime_error("zip_close");
  zip_stat_t stat;
  zip_stat_init(&stat);
  zip_source_stat(target, &stat);
  std::string bytes(stat.size, '\0');
  zip_source_open(target);
  zip_source_read(target, bytes.data(), bytes.size());
  zip_source_close(target);
  zip_source_free(target);
  zip_error_fini(&error);
  return bytes;
}

std::map<std::string, std::string> unzipped(const std::string& archive) {
  std::map<std::string, std::string> entries;
  const ZipArchive zip(archive);
  for (const std::string& name : zip.names()) entries[name] = zip.read(name);
  return entries;
}

double uniform(std::uint32_t stream, std::uint32_t i) {
  std::uint32_t x = i * 2654435761U + stream * 40503U + 12345U;
  x ^= x >> 15U;
  x *= 2246822519U;
  x ^= x >> 13U;
  return static_cast<double>(x >> 16U) / 65536.0;
}

}  // namespace earshot::freeze::test
