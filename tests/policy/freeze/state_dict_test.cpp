#include "policy/freeze/state_dict.hpp"

#include <gtest/gtest.h>

#include <span>

#include "firmware/core/crc32.hpp"
#include "tests/policy/freeze/bytes.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::freeze {
namespace {

using test::refusal;
using namespace std::string_literals;

std::uint32_t crc32_of(const std::vector<float>& values) {
  return crc32(std::span(reinterpret_cast<const std::uint8_t*>(values.data()), 4 * values.size()));
}

TEST(StateDict, HoldsEveryWeightBitForBit) {
  const StateDict state = read_state_dict(test::unzipped(test::model("memory.zip")).at("policy.pth"));
  const auto oracle = test::model_oracle().at("weights_crc32");
  ASSERT_EQ(state.size(), oracle.size());
  for (const auto& [name, crc] : oracle.items()) {
    ASSERT_TRUE(state.contains(name)) << name;
    EXPECT_EQ(crc32_of(state.at(name).values), std::stoul(crc.get<std::string>(), nullptr, 16)) << name;
  }
  EXPECT_EQ(state.at("action_net.weight").shape, (std::vector<std::size_t>{8, 64}));
}

/// One tensor "w" as torch.save writes it. @param numbers  pickled: storage size, then offset, shape, strides
struct Saved {
  std::string type = "ctorch\nFloatStorage\n";
  char count = 6;
  char offset = 0;
  std::string shape = "K\x02K\x03\x86";
  std::string strides = "K\x03K\x01\x86";
  std::string word = "storage";
  std::string callee = "ctorch._utils\n_rebuild_tensor_v2\n";

  [[nodiscard]] std::string bytes() const {
    const std::string storage = "(X\x07\0\0\0"s + word + type +
                                "X\x01\0\0\0"
                                "0X\x03\0\0\0"
                                "cpuK"s +
                                count + "tQ";
    const std::string arguments = "(" + storage + "K"s + offset + shape + strides +
                                  "\x89"
                                  "ccollections\nOrderedDict\n)Rt";
    const std::string pickle =
        "\x80\x02"
        "ccollections\nOrderedDict\n)R(X\x01\0\0\0w"s +
        callee + arguments + "Ru.";
    const float values[] = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
    return test::zip_of({{"archive/data.pkl", pickle}, {"archive/data/0", {reinterpret_cast<const char*>(values), sizeof values}}});
  }
  [[nodiscard]] std::string refused() const {
    return refusal([&] { (void)read_state_dict(bytes()); });
  }
};

TEST(StateDict, ReadsAHandmadeTensor) {
  const StateDict state = read_state_dict(Saved{}.bytes());
  EXPECT_EQ(state.at("w").shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(state.at("w").values, (std::vector<float>{0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F}));
}

TEST(StateDict, ReadsAPartOfAStorage) {
  const StateDict state = read_state_dict(Saved{.offset = 2, .shape = "K\x03\x85", .strides = "K\x01\x85"}.bytes());
  EXPECT_EQ(state.at("w").values, (std::vector<float>{2.0F, 3.0F, 4.0F}));
}

TEST(StateDict, ReadsASideOfOneWhateverItsStride) {
  const StateDict state = read_state_dict(Saved{.shape = "K\x01K\x03\x86", .strides = "K\x09K\x01\x86"}.bytes());
  EXPECT_EQ(state.at("w").values, (std::vector<float>{0.0F, 1.0F, 2.0F}));
}

TEST(StateDict, RefusesTensorsItWouldMisread) {
  EXPECT_NE(Saved{.type = "ctorch\nDoubleStorage\n"}.refused().find("torch.DoubleStorage"), std::string::npos);
  EXPECT_NE((Saved{.strides = "K\x01K\x02\x86"}.refused().find("row by row")), std::string::npos);
  EXPECT_NE(Saved{.type = "ccollections\nOrderedDict\n"}.refused().find("tensor w: not float32"), std::string::npos);
  EXPECT_NE(Saved{.type = "X\x12\0\0\0torch.FloatStorage"s}.refused().find("tensor w: not float32"), std::string::npos) << "a text";
  EXPECT_NE(Saved{.word = "storagf"}.refused().find("tensor w: has no storage"), std::string::npos);
  EXPECT_NE((Saved{.strides = "K\x04K\x01\x86"}.refused().find("row by row")), std::string::npos);
  EXPECT_NE((Saved{.shape = "K\x06\x85"}.refused().find("row by row")), std::string::npos) << "more strides than sides";
  EXPECT_NE(Saved{.offset = 1}.refused().find("beyond its storage"), std::string::npos);
  EXPECT_NE((Saved{.shape = "K\x09K\x03\x86"}.refused().find("beyond its storage")), std::string::npos);
  EXPECT_NE((Saved{.shape = "K\0K\x03\x86"s}.refused().find("size that cannot be")), std::string::npos);
  EXPECT_NE((Saved{.shape = "J\xff\xff\xff\xffK\x03\x86"}.refused().find("not negative")), std::string::npos);
  EXPECT_NE(Saved{.count = 5}.refused().find("its storage"), std::string::npos);
  EXPECT_NE(Saved{.callee = "ctorch._utils\n_rebuild_qtensor\n"}.refused().find("_rebuild_qtensor"), std::string::npos);
  EXPECT_NE(Saved{.callee = "cos\nsystem\n"}.refused().find("os.system"), std::string::npos);
}

/// Tensors may share a storage, each of which is unpacked for itself.
TEST(StateDict, RefusesMoreWeightsThanAnyPolicyHasInAllTensorsTogether) {
  constexpr std::size_t kHalf = std::size_t{512} * 1024;
  const std::string count = "\0\0\x08\0"s;  // the same, little-endian
  const auto saved = [&](int tensors) {
    std::string pickle =
        "\x80\x02"
        "ccollections\nOrderedDict\n)R(";
    for (int i = 0; i < tensors; ++i) {
      const std::string name = "w" + std::to_string(i);
      pickle += "X\x02\0\0\0"s + name + "ctorch._utils\n_rebuild_tensor_v2\n((X\x07\0\0\0storagectorch\nFloatStorage\nX\x01\0\0\0"s +
                "0X\x03\0\0\0"s + "cpuJ" + count + "tQK\0K\x01\x85K\x01\x85\x89"s + "ccollections\nOrderedDict\n)RtR";
    }
    return test::zip_of({{"archive/data.pkl", pickle + "u."}, {"archive/data/0", std::string(4 * kHalf, '\0')}});
  };
  EXPECT_EQ(read_state_dict(saved(2)).size(), 2U);
  EXPECT_TRUE(support::has_line(refusal([&] { (void)read_state_dict(saved(3)); }), {"tensor", "w2", "weights", "any"}));
}

TEST(StateDict, RefusesAnArchiveOfAnotherByteOrder) {
  auto entries = test::unzipped(Saved{}.bytes());
  entries["archive/byteorder"] = "big";
  EXPECT_NE(refusal([&] { (void)read_state_dict(test::zip_of(entries)); }).find("little-endian"), std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
