#include "policy/freeze/model_file.hpp"

#include <filesystem>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/onnx_model.hpp"
#include "policy/freeze/sb3_model.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;

constexpr std::size_t kLongestMessage = 300;

bool is_zip(std::string_view bytes) {
  return bytes.starts_with("PK");
}

}  // namespace

bool is_foreign_model(std::string_view bytes, const std::string& file) {
  return is_zip(bytes) || file.ends_with(".onnx") || file.ends_with(".zip");
}

TrainedActor read_model(std::string_view bytes, const std::string& file) {
  try {
    if (is_zip(bytes) || file.ends_with(".zip")) return read_sb3_model(bytes);
    return read_onnx_model(bytes, std::filesystem::path(file).parent_path());
  } catch (const BadInput& e) {
    throw BadInput(file + ": " + printable(e.what()));
  }
}

std::string printable(std::string_view text) {
  std::string line(text.substr(0, kLongestMessage));
  for (char& c : line) c = c >= ' ' && c <= '~' ? c : '?';
  return line;
}

}  // namespace earshot::freeze
