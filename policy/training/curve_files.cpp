#include "policy/training/curve_files.hpp"

#include <algorithm>
#include <stdexcept>

#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::training {
namespace {

using host::BadInput;

/// Some ten million episodes.
constexpr host::FileKind kLearningCurve{"a learning curve", std::uint64_t{1} << 30U};

/// A curve's file as it was when the checkpoint was written.
std::string earlier_part(const std::filesystem::path& path, const ppo::Continuation::Written& part) {
  host::InputFile file(path, kLearningCurve);
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(part.bytes, file.size())), '\0');
  text.resize(file.read({reinterpret_cast<std::uint8_t*>(text.data()), text.size()}));
  if (text.size() < part.bytes) throw BadInput(path.string() + ": shorter than when the checkpoint was written");
  if (host::crc32_of(text) != part.crc32) throw BadInput(path.string() + ": not the learning curve of the checkpoint");
  return text;
}

}  // namespace

std::filesystem::path updates_of(std::filesystem::path curve) {
  return curve.replace_extension(".updates.csv");
}

std::filesystem::path curve_beside(std::filesystem::path checkpoint) {
  return checkpoint.replace_extension(".csv");
}

std::filesystem::path with_seed(const std::filesystem::path& path, std::uint64_t seed) {
  std::filesystem::path result = path;
  return result.replace_extension(".seed" + std::to_string(seed) + path.extension().string());
}

std::string place_to_record(const std::filesystem::path& curve, const std::filesystem::path& checkpoint) {
  if (curve == curve_beside(checkpoint)) return {};
  const std::filesystem::path whole = std::filesystem::absolute(curve).lexically_normal();
  const std::filesystem::path below = whole.lexically_relative(std::filesystem::absolute(checkpoint).lexically_normal().parent_path());
  return below.empty() || *below.begin() == ".." ? whole.string() : below.string();
}

ppo::Continuation::Written written(const std::string& text) {
  return {text.size(), host::crc32_of(text)};
}

LearningCurve earlier_curve(const std::filesystem::path& curve, const ppo::Continuation& continuation) {
  try {
    return {earlier_part(curve, continuation.episodes), earlier_part(updates_of(curve), continuation.updates)};
  } catch (const std::invalid_argument& e) {
    throw BadInput(curve.string() + ": " + e.what());
  }
}

}  // namespace earshot::training
