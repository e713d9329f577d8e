#include "policy/freeze/onnx_model.hpp"

#include <gtest/gtest.h>

#include <span>

#include "firmware/core/crc32.hpp"
#include "policy/freeze/sb3_model.hpp"
#include "tests/policy/freeze/bytes.hpp"
#include "tests/policy/freeze/onnx/onnx_bytes.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::freeze {
namespace {

using test::bytes_of;
using test::field;
using test::integer_attribute;
using test::node;
using test::real_attribute;
using test::refusal;
using test::tensor;
using namespace std::string_literals;

const std::string kPriorities = field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5, 6})) + field(5, tensor("b", {2}, {7, 8}));
const std::string kWeightsTurned = field(5, tensor("w", {3, 2}, {1, 4, 2, 5, 3, 6})) + field(5, tensor("b", {2}, {7, 8}));
const std::string kEnds = field(11, field(1, "x"s)) + field(12, field(1, "y"s));
const std::string kTurned = integer_attribute("transB", 1);

std::string model_of(const std::string& graph) {
  return field(1, 8) + field(7, graph);
}
/// Of a model that stands in no folder of its own.
TrainedActor read_bytes(std::string_view bytes) {
  return read_onnx_model(bytes, "");
}
TrainedActor read(const std::string& graph) {
  return read_bytes(model_of(graph));
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

void expect_the_trained_weights(const TrainedActor& actor) {
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
}

TEST(OnnxModel, HoldsTheWeightsOfTheModelItWasExportedFrom) {
  const TrainedActor actor = read_bytes(test::model("memory.onnx"));
  expect_the_trained_weights(actor);
  EXPECT_TRUE(actor.search.has_value());
  EXPECT_TRUE(actor.data_files.empty());
}

TEST(OnnxModel, HoldsTheWeightsOfAFileBesideIt) {
  const std::filesystem::path folder = EARSHOT_SOURCE_DIR "/tests/policy/freeze/models";
  const TrainedActor actor = read_onnx_model(test::model("external.onnx"), folder);
  expect_the_trained_weights(actor);
  EXPECT_EQ(actor.data_files, std::vector{folder / "external.onnx.data"});
}

/// What PyTorch makes of Stable-Baselines3's own layers: observations cast to float32, and the biases, which are all zero before the
/// first training, written once.
TEST(OnnxModel, HoldsTheWeightsOfStableBaselines3sOwnLayers) {
  const TrainedActor actor = read_bytes(test::model("with_cast.onnx"));
  const TrainedActor saved = read_sb3_model(test::model("plain_save.zip"));
  ASSERT_EQ(actor.layers.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(actor.layers[i].weights, saved.layers[i].weights);
    EXPECT_EQ(actor.layers[i].bias, saved.layers[i].bias);
  }
}

/// By hand, of (x - (1, 2, 3)) / (2, 4, 8): weights over 2, 4 and 8; 7 - 1/2 - 2 2/4 - 3 3/8 and 8 - 4/2 - 5 2/4 - 6 3/8.
TEST(OnnxModel, FoldsWhatNormalisesObservationsIntoTheFirstLayer) {
  const std::string numbers = field(5, tensor("mean", {3}, {1, 2, 3})) + field(5, tensor("deviation", {1, 3}, {2, 4, 8})) +
                              field(5, tensor("inverse", {3}, {0.5, 0.25, 0.125})) + field(5, tensor("less", {3}, {-1, -2, -3})) +
                              field(5, tensor("variance", {3}, {3, 15, 63})) + field(5, tensor("one", {3}, {1, 1, 1})) +
                              field(5, tensor("zero", {3}, {0, 0, 0}));
  const std::string gemm = node("Gemm", {"n", "w", "b"}, "y", kTurned);
  const auto expect = [&](const std::string& front, const std::string& layer) {
    const TrainedActor actor = read(kEnds + kPriorities + field(5, tensor("turned", {3, 2}, {1, 4, 2, 5, 3, 6})) + numbers + front + layer);
    ASSERT_EQ(actor.layers.size(), 1U);
    EXPECT_EQ(actor.layers[0].weights, (std::vector<float>{0.5, 0.5, 0.375, 2, 1.25, 0.75}));
    EXPECT_EQ(actor.layers[0].bias, (std::vector<float>{4.375, 1.25}));
  };
  expect(node("Sub", {"x", "mean"}, "m") + node("Div", {"m", "deviation"}, "n"), gemm);
  expect(node("Add", {"less", "x"}, "m") + node("Mul", {"m", "inverse"}, "n"), gemm);
  expect(node("Sub", {"x", "mean"}, "m") + node("Div", {"m", "deviation"}, "n"),
         node("MatMul", {"n", "turned"}, "t") + node("Add", {"t", "b"}, "y"));
  const std::string epsilon = real_attribute("epsilon", 1.0F) + real_attribute("momentum", 0.9F) + integer_attribute("training_mode", 0);
  expect(node("BatchNormalization", {"x", "one", "zero", "mean", "variance"}, "n", epsilon), gemm);
}

TEST(OnnxModel, TakesOneNumberForAllElementsAlsoFromAConstant) {
  const std::string two = node("Constant", {}, "two", field(5, field(1, "value"s) + field(5, tensor("", {}, {2}))));
  const TrainedActor actor = read(kEnds + kPriorities + two + node("Mul", {"x", "two"}, "n") + node("Gemm", {"n", "w", "b"}, "y", kTurned));
  EXPECT_EQ(actor.layers[0].weights, (std::vector<float>{2, 4, 6, 8, 10, 12}));
  EXPECT_EQ(actor.layers[0].bias, (std::vector<float>{7, 8}));
}

TEST(OnnxModel, RefusesNormalisationsThatItCannotFoldIn) {
  const auto with = [](const std::string& front) {
    return refused(kEnds + kPriorities + field(5, tensor("few", {2}, {1, 2})) + field(5, tensor("null", {3}, {1, 0, 1})) +
                   field(5, tensor("square", {3, 3}, std::vector<float>(9, 1.0F))) + front + node("Gemm", {"n", "w", "b"}, "y", kTurned));
  };
  EXPECT_NE(with(node("Mul", {"x", "few"}, "n")).find("not as many numbers as the observation"), std::string::npos);
  EXPECT_NE(with(node("Div", {"x", "null"}, "n")).find("divides by zero"), std::string::npos);
  EXPECT_NE(with(node("Mul", {"x", "square"}, "n")).find("numbers of another shape"), std::string::npos);
  EXPECT_NE(with(node("Sub", {"null", "x"}, "n")).find("operator Sub: its numbers are not in the file"), std::string::npos);
  EXPECT_NE(with(node("Div", {"x", "null"}, "n", integer_attribute("axis", 1))).find("not as a normalisation"), std::string::npos);
  EXPECT_NE(with(node("Clip", {"x"}, "n")).find("operator Clip is unknown"), std::string::npos);
  const std::string training = integer_attribute("training_mode", 1);
  EXPECT_NE(with(node("BatchNormalization", {"x", "null", "null", "null", "null"}, "n", training)).find("training_mode"),
            std::string::npos);
  EXPECT_NE(with(node("BatchNormalization", {"x", "null", "null"}, "n")).find("four rows"), std::string::npos);
  EXPECT_NE(with(node("BatchNormalization", {"x", "null", "null", "few", "null"}, "n")).find("differ in length"), std::string::npos);
}

TEST(OnnxModel, TakesReluBetweenLayersAndNoMixtureOfItWithTanh) {
  const std::string weights = kEnds + kPriorities + field(5, tensor("v", {2, 2}, {1, 2, 3, 4}));
  const auto gemm = [](const char* from, const char* what, const char* to) { return node("Gemm", {from, what, "b"}, to, kTurned); };
  const TrainedActor actor = read(weights + gemm("x", "w", "t") + node("Relu", {"t"}, "u") + gemm("u", "v", "y"));
  EXPECT_EQ(actor.activation, policy::Activation::kRelu);
  ASSERT_EQ(actor.layers.size(), 2U);
  EXPECT_EQ(refused(weights + gemm("x", "w", "t") + node("Relu", {"t"}, "u") + gemm("u", "v", "s") + node("Tanh", {"s"}, "r") +
                    gemm("r", "v", "y")),
            "graph: tanh after one layer and ReLU after another; one of them flies");
}

TEST(OnnxModel, TakesACastToFloatWhereItChangesNothing) {
  const auto input_of = [](std::uint64_t type) { return field(11, field(1, "x"s) + field(2, field(1, field(1, type)))); };
  const std::string rest = field(12, field(1, "y"s)) + kPriorities + node("Gemm", {"f", "w", "b"}, "y", kTurned);
  const auto cast = [](std::uint64_t to) { return node("Cast", {"x"}, "f", integer_attribute("to", to)); };
  expect_the_layer(input_of(1) + rest + cast(1));
  expect_the_layer(input_of(11) + rest + cast(1));
  const std::string why = "operator Cast: only of observations that are float32 (or double) to float32: train on a Box of float32";
  for (const std::uint64_t type : {2, 3, 6, 7, 9, 10, 16}) EXPECT_EQ(refused(input_of(type) + rest + cast(1)), why) << type;
  for (const std::uint64_t type : {2, 6, 7, 10, 11, 16}) EXPECT_EQ(refused(input_of(1) + rest + cast(type)), why) << type;
  EXPECT_EQ(refused(field(11, field(1, "x"s)) + rest + cast(1)), why) << "nothing says what is cast";
  EXPECT_EQ(refused(input_of(1) + rest + node("Cast", {"x"}, "f")), why);
  EXPECT_EQ(refused(input_of(1) + rest + node("Cast", {"x"}, "f", integer_attribute("to", 1) + integer_attribute("saturate", 1))), why);
}

TEST(OnnxModel, TakesWeightsByTheirOtherName) {
  const std::string named = node("Identity", {"w"}, "v") + node("Identity", {"v"}, "u") + node("Identity", {"b"}, "c");
  expect_the_layer(kEnds + kPriorities + named + node("Gemm", {"x", "u", "c"}, "y", kTurned));
  EXPECT_NE(refused(kEnds + kPriorities + node("Identity", {"w"}, "b") + node("Gemm", {"x", "w", "b"}, "y", kTurned)).find("its output b"),
            std::string::npos);
}

TEST(OnnxModel, ReadsOneLayerHoweverItIsWritten) {
  expect_the_layer(kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "y", kTurned));
  expect_the_layer(kEnds + kPriorities +
                   node("Gemm", {"x", "w", "b"}, "y", kTurned + real_attribute("alpha", 1) + real_attribute("beta", 1)));
  expect_the_layer(kEnds + kWeightsTurned + node("Gemm", {"x", "w", "b"}, "y"));
  expect_the_layer(kEnds + kWeightsTurned + node("MatMul", {"x", "w"}, "t") + node("Add", {"t", "b"}, "y"));
  expect_the_layer(kEnds + kWeightsTurned + node("Add", {"b", "t"}, "y") + node("MatMul", {"x", "w"}, "t"));
  expect_the_layer(kEnds + kPriorities + node("Flatten", {"x"}, "f") + node("Gemm", {"f", "w", "b"}, "y", kTurned));
}

TEST(OnnxModel, ReadsWhatOtherExportersWriteBesideIt) {
  const std::string layer = node("Gemm", {"x", "w", "b"}, "y", kTurned);
  // Weights among the inputs, too, as up to ONNX's third version; names, notes, shapes and metadata of the graph.
  expect_the_layer(kEnds + field(11, field(1, "w"s)) + field(11, field(1, "b"s)) + kPriorities + layer);
  expect_the_layer(field(2, "graph"s) + field(10, "notes"s) + field(13, "shape"s) + field(16, "metadata"s) + kEnds + kPriorities + layer);
  expect_the_layer(kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "y", kTurned + field(7, "ai.onnx"s)));
  expect_the_layer(kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "y", kTurned + field(7, ""s) + integer_attribute("transA", 0)));
  expect_the_layer(kEnds + kPriorities + node("Identity", {"x"}, "f") + node("Gemm", {"f", "w", "b"}, "y", kTurned));
  expect_the_layer(kEnds + kPriorities + node("Flatten", {"x"}, "f", integer_attribute("axis", 1)) +
                   node("Gemm", {"f", "w", "b"}, "y", kTurned));
  // Sides in one packed field, values as floats, a note, data in the file itself.
  const std::vector<float> values{1, 2, 3, 4, 5, 6};
  const std::string floats = bytes_of(values);
  const std::string packed = field(1, "\x02\x03"s) + field(2, 1) + field(4, floats) + field(8, "w"s) + field(12, "a note"s) + field(14, 0);
  expect_the_layer(kEnds + field(5, packed) + field(5, tensor("b", {2}, {7, 8})) + layer);
}

TEST(OnnxModel, ReadsLayersWithTanhBetween) {
  const TrainedActor actor = read(kEnds + kPriorities + field(5, tensor("v", {2, 1}, {9, 10})) + field(5, tensor("c", {1}, {11})) +
                                  node("Gemm", {"x", "w", "b"}, "t", kTurned) + node("Tanh", {"t"}, "u") + node("MatMul", {"u", "v"}, "z") +
                                  node("Add", {"z", "c"}, "y"));
  ASSERT_EQ(actor.layers.size(), 2U);
  EXPECT_EQ(actor.layers[1].inputs, 2U);
  EXPECT_EQ(actor.layers[1].outputs, 1U);
  EXPECT_EQ(actor.layers[1].weights, (std::vector<float>{9, 10}));
  EXPECT_EQ(actor.layers[1].bias, (std::vector<float>{11}));
}

TEST(OnnxModel, SaysWhatItsMetadataSayItWasTrainedToSearch) {
  const auto entry = [](const std::string& key, const std::string& value) { return field(14, field(1, key) + field(2, value)); };
  const std::string model = model_of(kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "y", kTurned));
  EXPECT_FALSE(read_bytes(model + entry("other", "x")).search.has_value());
  EXPECT_EQ(read_bytes(model + entry("other", "x") + entry("earshot", "{}")).search, "{}");
  EXPECT_EQ(read_bytes(entry("earshot", "{}") + model).search, "{}");
  EXPECT_NE(refusal([&] { (void)read_bytes(model + entry("earshot", "{}") + entry("earshot", "{}")); }).find("given twice"),
            std::string::npos);
  EXPECT_NE(refusal([&] { (void)read_bytes(model + model); }).find("more than one graph"), std::string::npos);
}

TEST(OnnxModel, RefusesAGraphOfMoreThanItsInputAndItsOutput) {
  const std::string layer = kPriorities + node("Gemm", {"x", "w", "b"}, "y", kTurned);
  EXPECT_NE(refused(kEnds + layer + field(11, field(1, "z"s))).find("not one input"), std::string::npos);
  EXPECT_NE(refused(kEnds + layer + field(12, field(1, "z"s))).find("not one input"), std::string::npos);
  EXPECT_NE(refused(kEnds + layer + field(15, "sparse"s)).find("graph: field 15"), std::string::npos);
  EXPECT_NE(refused(kEnds + layer + field(5, tensor("b", {2}, {7, 8}))).find("initializer b: given twice"), std::string::npos);
  EXPECT_NE(refused(kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "y", kTurned + field(2, "z"s))).find("without its one output"),
            std::string::npos);
  EXPECT_NE(refused(field(11, field(1, 7)) + layer).find("a text that is a number"), std::string::npos);
}

TEST(OnnxModel, RefusesMoreOperatorsThanAnyPolicyHas) {
  const auto of_operators = [](int count) {
    std::string graph = kEnds + kPriorities;
    std::string last = "x";
    for (int i = 1; i < count; ++i) {
      const std::string next = "i" + std::to_string(i);
      graph += node("Identity", {last}, next);
      last = next;
    }
    return graph + node("Gemm", {last, "w", "b"}, "y", kTurned);
  };
  expect_the_layer(of_operators(64));
  EXPECT_NE(refused(of_operators(65)).find("more operators than any policy"), std::string::npos);
}

TEST(OnnxModel, RefusesOtherOperatorsByName) {
  const std::string layer = kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "t", kTurned);
  for (const std::string operation : {"LeakyRelu", "Softmax", "ArgMax", "Sigmoid", "Constant", "If", "Loop"}) {
    EXPECT_NE(refused(layer + node(operation, {"t"}, "y")).find("operator " + operation), std::string::npos);
    EXPECT_NE(refused(layer + node(operation, {"t"}, "y")).find("freeze the model's .zip"), std::string::npos);
  }
  EXPECT_NE(refused(layer + node("Tanh", {"t"}, "y", field(7, "com.microsoft"s))).find("com.microsoft"), std::string::npos);
}

TEST(OnnxModel, RefusesOperatorsWhereANetworkHasNone) {
  const std::string layer = kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "t", kTurned);
  EXPECT_NE(refused(layer + node("Tanh", {"t"}, "y")).find("does not end with a dense layer"), std::string::npos);
  EXPECT_NE(refused(layer + node("Add", {"t", "b"}, "y")).find("operator Add where"), std::string::npos);
  EXPECT_NE(refused(layer + node("Gemm", {"t", "w", "b"}, "y", kTurned)).find("operator Gemm where"), std::string::npos);
  EXPECT_NE(refused(kEnds + kWeightsTurned + node("MatMul", {"x", "w"}, "y")).find("does not end"), std::string::npos);
  EXPECT_NE(refused(layer + node("Tanh", {"t"}, "u") + node("Add", {"t", "u"}, "y")).find("more than one way"), std::string::npos);
  EXPECT_NE(refused(layer + node("Tanh", {"z"}, "y")).find("goes nowhere"), std::string::npos);
  EXPECT_NE(refused(layer).find("not one chain"), std::string::npos);
  EXPECT_NE(refused(layer + node("Identity", {"t"}, "y")).find("operator Identity where"), std::string::npos);
  const std::string pair = node("Gemm", {"f", "w", "b"}, "y", kTurned);
  EXPECT_NE(refused(kEnds + kPriorities + node("Flatten", {"x"}, "f", integer_attribute("axis", 0)) + pair).find("operator Flatten where"),
            std::string::npos);
  EXPECT_NE(refused(kEnds + kPriorities + node("Flatten", {"x"}, "f", integer_attribute("axle", 1)) + pair).find("operator Flatten where"),
            std::string::npos);
  EXPECT_NE(refused(kEnds + kPriorities + node("Identity", {"x", "w"}, "f") + pair).find("operator Identity where"), std::string::npos);
  EXPECT_NE(refused(layer + node("Tanh", {"t", "b"}, "y")).find("operator Tanh where"), std::string::npos);
  const std::string twice = layer + node("Tanh", {"t"}, "u") + node("Gemm", {"u", "w", "b"}, "y", kTurned);
  EXPECT_TRUE(support::has_line(refused(twice), {"layer 2 takes", "3 inputs", "before", "2"}));
}

TEST(OnnxModel, RefusesAnOutputThatWritesOverAnotherValue) {
  const std::string ends = field(11, field(1, "x"s)) + kPriorities;
  const auto layer_to = [&](const std::string& output) {
    return refused(ends + field(12, field(1, output)) + node("Gemm", {"x", "w", "b"}, output, kTurned));
  };
  EXPECT_EQ(layer_to("y"), "");
  EXPECT_TRUE(support::has_line(layer_to("b"), {"output", "name", "value"}));
  EXPECT_TRUE(support::has_line(layer_to("x"), {"output", "name", "value"}));
  EXPECT_NE(refused(kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "y", kTurned) + node("Tanh", {"z"}, "y")).find("its output y"),
            std::string::npos);
}

TEST(OnnxModel, RefusesAGemmThatIsNoDenseLayer) {
  const auto gemm = [](const std::string& attributes) {
    return refused(kEnds + kPriorities + node("Gemm", {"x", "w", "b"}, "y", attributes));
  };
  EXPECT_NE(gemm(kTurned + real_attribute("alpha", 0.5F)).find("alpha"), std::string::npos);
  EXPECT_NE(gemm(kTurned + real_attribute("beta", 0.5F)).find("beta"), std::string::npos);
  EXPECT_NE(gemm(integer_attribute("transB", 2)).find("transB"), std::string::npos);
  EXPECT_NE(gemm(integer_attribute("transB", 0)).find("bias that does not fit"), std::string::npos);
  EXPECT_NE(gemm(kTurned + integer_attribute("transA", 1)).find("transA"), std::string::npos);
  EXPECT_NE(gemm(kTurned + integer_attribute("broadcast", 1)).find("broadcast"), std::string::npos);
  EXPECT_NE(refused(kEnds + kPriorities + node("Gemm", {"x", "w"}, "y", kTurned)).find("without a bias"), std::string::npos);
  EXPECT_NE(gemm("").find("bias that does not fit"), std::string::npos);  // [2 x 3] not turned takes 2 inputs, gives 3
}

TEST(OnnxModel, RefusesAMatMulAndAnAddThatAreNoDenseLayer) {
  const auto refused_with = [](const std::string& matmul, const std::string& add) {
    return refused(kEnds + kWeightsTurned + matmul + add);
  };
  const std::string matmul = node("MatMul", {"x", "w"}, "t");
  const std::string add = node("Add", {"t", "b"}, "y");
  EXPECT_EQ(refused_with(matmul, add), "");
  EXPECT_NE(refused_with(node("MatMul", {"x", "w", "b"}, "t"), add).find("operator MatMul: not as"), std::string::npos);
  EXPECT_NE(refused_with(node("MatMul", {"x", "w"}, "t", kTurned), add).find("operator MatMul: not as"), std::string::npos);
  EXPECT_NE(refused_with(node("MatMul", {"w", "x"}, "t"), add).find("operator MatMul: its weights are not"), std::string::npos);
  EXPECT_NE(refused_with(matmul, node("Add", {"t", "b", "b"}, "y")).find("operator Add: not as"), std::string::npos);
  EXPECT_NE(refused_with(matmul, node("Add", {"t", "b"}, "y", kTurned)).find("operator Add: not as"), std::string::npos);
  EXPECT_NE(refused_with(matmul, node("Add", {"t", "w"}, "y")).find("operator Add: weights of another shape"), std::string::npos);
  EXPECT_NE(refused_with(matmul, node("Add", {"t", "z"}, "y")).find("operator Add: its weights are not"), std::string::npos);
}

TEST(OnnxModel, RefusesSidesThatNoWeightsHave) {
  const std::string rest = kEnds + node("Gemm", {"x", "w", "b"}, "y", kTurned) + field(5, tensor("b", {2}, {7, 8}));
  EXPECT_NE(refused(rest + field(5, tensor("w", {2, 0}, {}))).find("initializer w: of a size that cannot be"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {65'537, 1}, {}))).find("of a size that cannot be"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {65'536, 1}, {}))).find("not as many numbers"), std::string::npos);
  // 2^64 would be none at all
  EXPECT_NE(refused(rest + field(5, tensor("w", {65'536, 65'536, 65'536, 65'536}, {}))).find("of a size that cannot be"),
            std::string::npos);
  const std::string half = field(1, 1) + field(2, 1) + field(8, "w"s) + field(9, "\0\0\0\0\0\0"s);
  EXPECT_NE(refused(rest + field(5, half)).find("half a number at the end"), std::string::npos);
}

TEST(OnnxModel, RefusesWeightsThatAreNotPlainFloatsInTheFile) {
  const std::string rest = kEnds + node("Gemm", {"x", "w", "b"}, "y", kTurned) + field(5, tensor("b", {2}, {7, 8}));
  EXPECT_NE(refused(rest).find("not in the file"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5, 6}, 11))).find("not float32"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5}))).find("not as many numbers"), std::string::npos);
  EXPECT_NE(refused(rest + field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5, 6}) + field(3, ""s))).find("field 3"),
            std::string::npos);  // segment
  EXPECT_NE(refused(rest + field(5, tensor("w", {6}, {1, 2, 3, 4, 5, 6}))).find("another shape"), std::string::npos);
}

TEST(OnnxModel, RefusesWhatIsNoModel) {
  EXPECT_NE(refusal([] { (void)read_bytes(""); }).find("not an ONNX model"), std::string::npos);
  EXPECT_NE(refusal([] { (void)read_bytes("swordfish"); }), "");
  EXPECT_NE(refusal([] { (void)read_bytes(field(25, ""s)); }).find("functions"), std::string::npos);
  const std::string whole = test::model("memory.onnx");
  EXPECT_NE(refusal([&] { (void)read_bytes(std::string_view(whole).substr(0, whole.size() / 2)); }).find("cut short"), std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
