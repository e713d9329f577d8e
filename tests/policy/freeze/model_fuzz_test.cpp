// Models somebody mangled: whatever the bytes are, they are read or refused in one line. Run under AddressSanitizer with the asan preset.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "firmware/core/random.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/search_description.hpp"
#include "policy/freeze/freeze.hpp"
#include "policy/freeze/model_file.hpp"
#include "tests/policy/freeze/bytes.hpp"

namespace earshot::freeze {
namespace {

constexpr int kMutants = 2'000;

/// One to four small changes: bits, bytes that are often special, a piece cut out, repeated or moved, an end cut off.
std::string mutant_of(std::string bytes, Pcg32& random) {
  static constexpr std::array<char, 8> kSpecial = {'\0', '\x01', '\x7f', '\x80', '\xff', 'R', 'c', '('};
  for (std::uint32_t change = random.next() % 4 + 1; change > 0 && !bytes.empty(); --change) {
    const std::size_t at = random.next() % bytes.size();
    const std::size_t size = std::min<std::size_t>(random.next() % 16 + 1, bytes.size() - at);
    const std::string piece = bytes.substr(at, size);
    switch (random.next() % 6) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.next() % 8));
        break;
      case 1:
        bytes[at] = kSpecial[random.next() % kSpecial.size()];
        break;
      case 2:
        bytes.erase(at, size);
        break;
      case 3:
        bytes.insert(at, piece);
        break;
      case 4:
        bytes.insert(random.next() % bytes.size(), piece);
        break;
      default:
        if (random.next() % 8 == 0) bytes.resize(at);
    }
  }
  return bytes;
}

/// Whether the bytes were read and frozen; else they were refused in one line.
bool is_frozen(const std::string& bytes, const std::string& file) {
  try {
    const TrainedActor actor = read_model(bytes, file);
    if (!actor.search) return false;
    (void)freeze(actor, description::from_text(*actor.search), policy::ActionDraw::kArgmax);
    return true;
  } catch (const host::BadInput& e) {
    const std::string said = e.what();
    EXPECT_FALSE(said.empty());
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return false;
  }
}

/// Makes `kMutants` of `seed`, each placed in a model by `model_with`; most are refused, not all.
template <class ModelWith>
void fuzz(const std::string& seed, const std::string& file, ModelWith model_with) {
  ASSERT_TRUE(is_frozen(model_with(seed), file));
  Pcg32 random(7);
  int refused = 0;
  for (int i = 0; i < kMutants; ++i) refused += is_frozen(model_with(mutant_of(seed, random)), file) ? 0 : 1;
  EXPECT_GT(refused, kMutants / 2);
  EXPECT_LT(refused, kMutants);
}

template <class Place>
void fuzz_entry(const std::string& entry, Place place) {
  const auto entries = test::unzipped(test::model("named_tanh.zip"));
  fuzz(entries.at(entry), "model.zip", [&](const std::string& bytes) {
    auto changed = entries;
    changed[entry] = place(bytes);
    return test::zip_of(changed);
  });
}

TEST(ModelFuzz, AMangledArchiveIsReadOrRefused) {
  fuzz(test::model("named_tanh.zip"), "model.zip", [](const std::string& bytes) { return bytes; });
}

TEST(ModelFuzz, MangledDataIsReadOrRefused) {
  fuzz_entry("data", [](const std::string& bytes) { return bytes; });
}

TEST(ModelFuzz, AMangledSearchDescriptionIsReadOrRefused) {
  fuzz_entry("earshot.json", [](const std::string& bytes) { return bytes; });
}

TEST(ModelFuzz, AMangledPickleIsReadOrRefused) {
  const auto entries = test::unzipped(test::model("named_tanh.zip"));
  const auto inner = test::unzipped(entries.at("policy.pth"));
  fuzz(inner.at("archive/data.pkl"), "model.zip", [&](const std::string& pickle) {
    auto outer_changed = entries;
    auto inner_changed = inner;
    inner_changed["archive/data.pkl"] = pickle;
    outer_changed["policy.pth"] = test::zip_of(inner_changed);
    return test::zip_of(outer_changed);
  });
}

TEST(ModelFuzz, AMangledOnnxModelIsReadOrRefused) {
  fuzz(test::model("memory.onnx"), "model.onnx", [](const std::string& bytes) { return bytes; });
}

TEST(ModelFuzz, AMangledOnnxModelWhoseWeightsStandBesideItIsReadOrRefused) {
  fuzz(test::model("external.onnx"), EARSHOT_SOURCE_DIR "/tests/policy/freeze/models/external.onnx",
       [](const std::string& bytes) { return bytes; });
}

}  // namespace
}  // namespace earshot::freeze
