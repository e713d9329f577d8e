#include "policy/freeze/zip_archive.hpp"

#include <zip.h>

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::freeze {

using host::BadInput;

ZipArchive::ZipArchive(std::string_view bytes) : archive_(nullptr, zip_discard) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
  if (!archive_ && source != nullptr) zip_source_free(source);
  zip_error_fini(&error);
  if (!archive_ || bytes.empty()) throw BadInput("not a zip archive, or cut short");
  const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* name = zip_get_name(archive_.get(), index, ZIP_FL_ENC_RAW);
    if (name == nullptr) throw BadInput("zip archive: an entry without a name");
    if (!entries_.emplace(name, index).second) throw BadInput("zip archive: names an entry twice");
  }
}

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> names;
  for (const auto& [name, index] : entries_) names.push_back(name);
  return names;
}

std::string ZipArchive::read(const std::string& name) const {
  const auto entry = entries_.find(name);
  if (entry == entries_.end()) throw BadInput("zip archive: has no entry " + name);
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive_.get(), entry->second, 0), zip_fclose);
  if (!file) throw BadInput("zip archive: entry " + name + " cannot be unpacked");
  std::string content;
  std::string part(std::size_t{64} * 1024, '\0');
  for (;;) {
    const zip_int64_t size = zip_fread(file.get(), part.data(), part.size());
    if (size < 0) throw BadInput("zip archive: entry " + name + " is damaged");
    if (size == 0) return content;
    content.append(part, 0, static_cast<std::size_t>(size));
    if (content.size() > kMaxEntryBytes) throw BadInput("zip archive: entry " + name + " is over 16 MiB");
  }
}

std::string ZipArchive::name_ending_in(std::string_view ending) const {
  const std::string* found = nullptr;
  for (const auto& [name, index] : entries_) {
    if (!name.ends_with(ending)) continue;
    if (found != nullptr) throw BadInput("zip archive: more than one entry ends in " + std::string(ending));
    found = &name;
  }
  if (found == nullptr) throw BadInput("zip archive: no entry ends in " + std::string(ending));
  return *found;
}

}  // namespace earshot::freeze
