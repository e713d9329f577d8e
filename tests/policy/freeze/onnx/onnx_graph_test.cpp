#include "policy/freeze/onnx/onnx_graph.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "policy/freeze/onnx_model.hpp"
#include "policy/freeze/sb3_model.hpp"
#include "tests/policy/freeze/bytes.hpp"
#include "tests/policy/freeze/onnx/onnx_bytes.hpp"

namespace earshot::freeze {
namespace {

using test::field;
using test::integer_attribute;
using test::node;
using test::refusal;
using test::tensor;
using namespace std::string_literals;

TrainedActor actor_in(std::string_view bytes) {
  return read_onnx_model(bytes, "");
}

/// Actions, values and log-probabilities: the logits are what the actions are the largest of.
TEST(OnnxGraph, HoldsTheWeightsOfTheExportThatStableBaselines3Documents) {
  const TrainedActor actor = actor_in(test::model("documented.onnx"));
  const TrainedActor saved = read_sb3_model(test::model("plain_save.zip"));
  ASSERT_EQ(actor.layers.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(actor.layers[i].weights, saved.layers[i].weights);
    EXPECT_EQ(actor.layers[i].bias, saved.layers[i].bias);
  }
}

/// Actions, values and log-probabilities of one layer's logits t, as torch writes them. @param action  the operators from t to the action
std::string documented(const std::string& action) {
  return field(11, field(1, "x"s)) + field(12, field(1, "a"s)) + field(12, field(1, "v"s)) + field(12, field(1, "p"s)) +
         field(5, tensor("w", {2, 3}, {1, 2, 3, 4, 5, 6})) + field(5, tensor("b", {2}, {7, 8})) +
         node("Gemm", {"x", "w", "b"}, "t", integer_attribute("transB", 1)) + node("Relu", {"t"}, "v") + node("Neg", {"t"}, "p") + action;
}

std::string complaint_about(const std::string& graph) {
  return refusal([&] { (void)actor_in(field(7, graph)); });
}

void expect_its_layer(const std::string& graph) {
  const TrainedActor actor = actor_in(field(7, graph));
  ASSERT_EQ(actor.layers.size(), 1U);
  EXPECT_EQ(actor.layers[0].weights, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(actor.layers[0].bias, (std::vector<float>{7, 8}));
}

TEST(OnnxGraph, TakesActionsThatAreTheLargestLogitOfARow) {
  const auto axis = [](std::uint64_t value) { return integer_attribute("axis", value); };
  const std::string row = field(5, field(1, "axes"s) + field(8, std::uint64_t(-1)));
  const std::string column = field(5, field(1, "axes"s) + field(8, 0));
  const std::string arg_max = node("ArgMax", {"s"}, "a", axis(1));
  expect_its_layer(documented(node("ArgMax", {"t"}, "a", axis(std::uint64_t(-1)))));
  expect_its_layer(documented(node("Softmax", {"t"}, "s", axis(1)) + arg_max));
  expect_its_layer(documented(node("LogSoftmax", {"t"}, "s", axis(1)) + node("ArgMax", {"s"}, "c", axis(1)) +
                              node("Cast", {"c"}, "d", integer_attribute("to", 7)) + node("Reshape", {"d", "shape"}, "a")));
  expect_its_layer(documented(node("ReduceLogSumExp", {"t"}, "l", row) + node("Sub", {"t", "l"}, "s") + arg_max));
  const auto is_refused = [](const std::string& action) {
    const std::string said = complaint_about(documented(action));
    return said.find("one output (logits) but 1 and 3") != std::string::npos &&
           said.find("earshot.gym.sb3.export_onnx") != std::string::npos && said.find("freeze the model's .zip") != std::string::npos;
  };
  EXPECT_TRUE(is_refused(node("ArgMax", {"t"}, "a", axis(0)))) << "the largest of a column";
  EXPECT_TRUE(is_refused(node("ArgMax", {"t"}, "a"))) << "so is that without an axis";
  EXPECT_TRUE(is_refused(node("ArgMin", {"t"}, "a", axis(1))));
  EXPECT_TRUE(is_refused(node("Reshape", {"a", "a"}, "a"))) << "round in a circle";
  // What changes the logits by more than one number for all is not left out, and so is unknown, or a layer where none can be.
  EXPECT_NE(complaint_about(documented(node("Neg", {"t"}, "s") + arg_max)).find("operator Neg is unknown"), std::string::npos);
  EXPECT_NE(complaint_about(documented(node("ReduceLogSumExp", {"t"}, "l", column) + node("Sub", {"t", "l"}, "s") + arg_max))
                .find("ReduceLogSumExp"),
            std::string::npos);
  EXPECT_NE(complaint_about(documented(node("Softmax", {"t"}, "s", axis(0)) + arg_max)).find("operator Softmax is unknown"),
            std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
