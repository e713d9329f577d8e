#include "policy/freeze/onnx_model.hpp"

#include <gtest/gtest.h>

#include <span>

#include "firmware/core/crc32.hpp"
#include "tests/policy/freeze/bytes.hpp"

namespace earshot::freeze {
namespace {

using test::refusal;
using namespace std::string_literals;

// Messages of onnx.proto3, written by hand.

std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 0x7F; value >>= 7U) bytes.push_back(static_cast<char>((value & 0x7FU) | 0x80U));
  bytes.push_back(static_cast<char>(value));
  return bytes;
}
std::string field(unsigned number, const std::string& content) {
  return varint(number << 3U | 2U) + varint(content.size()) + content;
}
std::string field(unsigned number, std::uint64_t value) {
  return varint(number << 3U) + varint(value);
}
std::string real_field(unsigned number, float value) {
  return varint(number << 3U | 5U) + std::string(reinterpret_cast<const char*>(&value), 4);
}

std::string tensor(const std::string& name, std::initializer_list<std::uint64_t> shape, const std::vector<float>& values,
                   std::uint64_t type = 1) {
  std::string bytes;
  for (const std::uint64_t side : shape) bytes += field(1, side);
  return bytes + field(2, type) + field(8, name) + field(9, {reinterpret_cast<const char*>(values.data()), 4 * values.size()});
}
std::string node(const std::string& operation, std::initializer_list<std::string> inputs, const std::string& output,
                 const std::string& attributes = "") {
  std::string bytes;
  for (const std::string& input : inputs) bytes += field(1, input);
  return field(1, bytes + field(2, output) + field(4, operation) + attributes);
}
std::string integer_attribute(const std::string& name, std::uint64_t value) {
  return field(5, field(1, name) + field(3, value));
}
std::string real_attribute(const std::string& name, float value) {
  return field(5, field(1, name) + real_field(2, value));
}

const std::string kWeights = field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5, 6})) + field(5, tensor("b", {2}, {7, 8}));
const std::string kWeightsTurned = field(5, tensor("w", {3, 2}, {1, 4, 2, 5, 3, 6})) + field(5, tensor("b", {2}, {7, 8}));
const std::string kEnds = field(11, field(1, "x"s)) + field(12, field(1, "y"s));
const std::string kTurned = integer_attribute("transB", 1);

std::string model_of(const std::string& graph) {
  return field(1, 8) + field(7, graph);
}
TrainedActor read(const std::string& graph) {
  return read_onnx_model(model_of(graph));
}
std::string refused(const std::string& graph) {
  return refusal([&] { (void)read(graph); });
}

void expect_the_layer(const std::string& graph) {
  const TrainedActor actor = read(graph);
  ASSERT_EQ(actor.layers.size(), 1U);
  EXPECT_EQ(actor.layers[0].inputs, 3U);
  EXPECT_EQ(actor.layers[0].outputs, 2U);
  EXPECT_EQ(actor.layers[0].weights, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(actor.layers[0].bias, (std::vector<float>{7, 8}));
}

TEST(OnnxModel, HoldsTheWeightsOfTheModelItWasExportedFrom) {
  const TrainedActor actor = read_onnx_model(test::model("memory.onnx"));
  const auto oracle = test::model_oracle().at("weights_crc32");
  const auto expect = [&](const std::vector<float>& values, const char* name) {
    const std::uint32_t crc = crc32(std::span(reinterpret_cast<const std::uint8_t*>(values.data()), 4 * values.size()));
    EXPECT_EQ(crc, std::stoul(oracle.at(name).get<std::string>(), nullptr, 16)) << name;
  };
  ASSERT_EQ(actor.layers.size(), 3U);
  expect(actor.layers[0].weights, "mlp_extractor.policy_net.0.weight");
  expect(actor.layers[0].bias, "mlp_extractor.policy_net.0.bias");
  expect(actor.layers[1].weights, "mlp_extractor.policy_net.2.weight");
  expect(actor.layers[1].bias, "mlp_extractor.policy_net.2.bias");
  expect(actor.layers[2].weights, "action_net.weight");
  expect(actor.layers[2].bias, "action_net.bias");
  EXPECT_TRUE(actor.search.has_value());
}

TEST(OnnxModel, ReadsOneLayerHoweverItIsWritten) {
  expect_the_layer(kEnds + kWeights + node("Gemm", {"x", "w", "b"}, "y", kTurned));
  expect_the_layer(kEnds + kWeights + node("Gemm", {"x", "w", "b"}, "y", kTurned + real_attribute("alpha", 1) + real_attribute("beta", 1)));
  expect_the_layer(kEnds + kWeightsTurned + node("Gemm", {"x", "w", "b"}, "y"));
  expect_the_layer(kEnds + kWeightsTurned + node("MatMul", {"x", "w"}, "t") + node("Add", {"t", "b"}, "y"));
  expect_the_layer(kEnds + kWeightsTurned + node("Add", {"b", "t"}, "y") + node("MatMul", {"x", "w"}, "t"));
  expect_the_layer(kEnds + kWeights + node("Flatten", {"x"}, "f") + node("Gemm", {"f", "w", "b"}, "y", kTurned));
}

TEST(OnnxModel, RefusesOtherOperatorsByName) {
  const std::string layer = kEnds + kWeights + node("Gemm", {"x", "w", "b"}, "t", kTurned);
  for (const std::string operation : {"Relu", "Softmax", "ArgMax", "Sigmoid", "Constant", "If", "Loop"}) {
    EXPECT_NE(refused(layer + node(operation, {"t"}, "y")).find("operator " + operation), std::string::npos);
  }
  EXPECT_NE(refused(layer + node("Tanh", {"t"}, "y", field(7, "com.microsoft"s))).find("com.microsoft"), std::string::npos);
}

TEST(OnnxModel, RefusesOperatorsWhereANetworkHasNone) {
  const std::string layer = kEnds + kWeights + node("Gemm", {"x", "w", "b"}, "t", kTurned);
  EXPECT_NE(refused(layer + node("Tanh", {"t"}, "y")).find("does not end with a dense layer"), std::string::npos);
  EXPECT_NE(refused(layer + node("Add", {"t", "b"}, "y")).find("operator Add where"), std::string::npos);
  EXPECT_NE(refused(layer + node("Gemm", {"t", "w", "b"}, "y", kTurned)).find("operator Gemm where"), std::string::npos);
  EXPECT_NE(refused(kEnds + kWeightsTurned + node("MatMul", {"x", "w"}, "y")).find("does not end"), std::string::npos);
  EXPECT_NE(refused(layer + node("Tanh", {"t"}, "u") + node("Add", {"t", "u"}, "y")).find("more than one way"), std::string::npos);
  EXPECT_NE(refused(layer + node("Tanh", {"z"}, "y")).find("goes nowhere"), std::string::npos);
  EXPECT_NE(refused(layer).find("not one chain"), std::string::npos);
}

TEST(OnnxModel, RefusesAnOutputThatWritesOverAnotherValue) {
  const std::string ends = field(11, field(1, "x"s)) + kWeights;
  const auto layer_to = [&](const std::string& output) {
    return refused(ends + field(12, field(1, output)) + node("Gemm", {"x", "w", "b"}, output, kTurned));
  };
  EXPECT_EQ(layer_to("y"), "");
  EXPECT_NE(layer_to("b").find("its output b is the name of another value"), std::string::npos);
  EXPECT_NE(layer_to("x").find("its output x is the name of another value"), std::string::npos);
  EXPECT_NE(refused(kEnds + kWeights + node("Gemm", {"x", "w", "b"}, "y", kTurned) + node("Tanh", {"z"}, "y")).find("its output y"),
            std::string::npos);
}

TEST(OnnxModel, RefusesAGemmThatIsNoDenseLayer) {
  const auto gemm = [](const std::string& attributes) {
    return refused(kEnds + kWeights + node("Gemm", {"x", "w", "b"}, "y", attributes));
  };
  EXPECT_NE(gemm(kTurned + real_attribute("alpha", 0.5F)).find("alpha"), std::string::npos);
  EXPECT_NE(gemm(kTurned + integer_attribute("transA", 1)).find("transA"), std::string::npos);
  EXPECT_NE(gemm(kTurned + integer_attribute("broadcast", 1)).find("broadcast"), std::string::npos);
  EXPECT_NE(refused(kEnds + kWeights + node("Gemm", {"x", "w"}, "y", kTurned)).find("without a bias"), std::string::npos);
  EXPECT_NE(gemm("").find("bias that does not fit"), std::string::npos);  // [2 x 3] not turned takes 2 inputs, gives 3
}

TEST(OnnxModel, RefusesWeightsThatAreNotPlainFloatsInTheFile) {
  const std::string rest = kEnds + node("Gemm", {"x", "w", "b"}, "y", kTurned) + field(5, tensor("b", {2}, {7, 8}));
  EXPECT_NE(refused(rest).find("not in the file"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5, 6}, 11))).find("not float32"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5}))).find("not as many numbers"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {2, 3}, {}) + field(13, "x"s))).find("field 13"), std::string::npos);  // external_data
  EXPECT_NE(refused(rest + field(5, tensor("w", {6}, {1, 2, 3, 4, 5, 6}))).find("another shape"), std::string::npos);
}

TEST(OnnxModel, RefusesWhatIsNoModel) {
  EXPECT_NE(refusal([] { (void)read_onnx_model(""); }).find("not an ONNX model"), std::string::npos);
  EXPECT_NE(refusal([] { (void)read_onnx_model("swordfish"); }), "");
  EXPECT_NE(refusal([] { (void)read_onnx_model(field(25, ""s)); }).find("functions"), std::string::npos);
  const std::string whole = test::model("memory.onnx");
  EXPECT_NE(refusal([&] { (void)read_onnx_model(std::string_view(whole).substr(0, whole.size() / 2)); }).find("cut short"),
            std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
