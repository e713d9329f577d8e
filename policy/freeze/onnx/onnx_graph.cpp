#include "policy/freeze/onnx/onnx_graph.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <set>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/onnx/protobuf.hpp"

// Field numbers are those of onnx.proto3 (ONNX 1.17), the schema of every version up to it.

namespace earshot::freeze {
namespace {

using host::BadInput;
using Graph = OnnxGraph;
using Node = OnnxNode;
using Value = OnnxValue;
using Attribute = OnnxAttribute;

constexpr std::size_t kMaxNodes = 64;  ///< operators of a graph; the networks that fly have eight, and a documented export some fifty

Attribute read_attribute(std::string_view bytes) {
  Attribute attribute;
  ProtobufReader reader(bytes);
  while (const auto field = reader.next()) {
    if (field->number == 1) attribute.name = text_of(*field);
    if (field->number == 2) attribute.real = std::bit_cast<float>(static_cast<std::uint32_t>(field->value));
    if (field->number == 3) attribute.integer = static_cast<std::int64_t>(field->value);
    if (field->number == 5) attribute.tensor = field->bytes;
    if (field->number != 8) continue;
    if (field->wire == ProtobufReader::Wire::kVarint) attribute.integers.push_back(static_cast<std::int64_t>(field->value));
    for (ProtobufReader packed(field->bytes); !packed.at_end();) attribute.integers.push_back(static_cast<std::int64_t>(packed.varint()));
  }
  return attribute;
}

Node read_node(std::string_view bytes) {
  Node node;
  ProtobufReader reader(bytes);
  while (const auto field = reader.next()) {
    if (field->number == 1) node.inputs.push_back(text_of(*field));
    if (field->number == 2) node.outputs.push_back(text_of(*field));
    if (field->number == 4) node.operation = text_of(*field);
    if (field->number == 5) node.attributes.push_back(read_attribute(field->bytes));
    if (field->number == 7 && !field->bytes.empty() && field->bytes != "ai.onnx") {
      throw BadInput("operator domain " + text_of(*field) + " is unknown");
    }
  }
  if (node.outputs.size() != 1) throw BadInput("operator " + node.operation + " without its one output");
  return node;
}

/// The content of a message's field of that number; empty where it has none.
std::string_view part_of(std::string_view message, std::uint32_t number) {
  std::string_view part;
  for (ProtobufReader reader(message); const auto field = reader.next();) {
    if (field->number == number) part = field->bytes;
  }
  return part;
}

Value read_value(std::string_view bytes) {
  Value value;
  ProtobufReader reader(bytes);
  while (const auto field = reader.next()) {
    if (field->number == 1) value.name = text_of(*field);
    if (field->number != 2) continue;
    for (ProtobufReader tensor(part_of(field->bytes, 1)); const auto of_tensor = tensor.next();) {
      if (of_tensor->number == 1) value.type = of_tensor->value;
    }
  }
  return value;
}

/// Every value has one origin: whoever reads the graph follows names.
void check_outputs(const Graph& graph) {
  std::set<std::string> given;
  for (const Value& input : graph.inputs) given.insert(input.name);
  for (const auto& [name, tensor] : graph.initializers) given.insert(name);
  for (const Node& node : graph.nodes) {
    if (given.insert(node.outputs[0]).second) continue;
    throw BadInput("operator " + node.operation + ": its output " + node.outputs[0] + " is the name of another value");
  }
}

const Node* maker_of(const Graph& graph, const std::string& value) {
  const auto maker = std::ranges::find_if(graph.nodes, [&value](const Node& node) { return node.outputs[0] == value; });
  return maker == graph.nodes.end() || maker->inputs.empty() ? nullptr : &*maker;
}

/// Whether an operator works along each row of numbers [batch x size].
bool is_along_rows(const Node& node) {
  return std::ranges::any_of(node.attributes, [](const Attribute& a) {
    const bool is_axis = a.name == "axis" && (a.integer == 1 || a.integer == -1);
    return is_axis || (a.name == "axes" && (a.integers == std::vector<std::int64_t>{1} || a.integers == std::vector<std::int64_t>{-1}));
  });
}

/// The value less the logarithm of the sum of its exponentials: all of a row change by one number.
bool is_normalised_logits(const Graph& graph, const Node& node) {
  const Node* sum = node.operation == "Sub" && node.inputs.size() == 2 ? maker_of(graph, node.inputs[1]) : nullptr;
  return sum != nullptr && sum->operation == "ReduceLogSumExp" && sum->inputs.size() == 1 && sum->inputs[0] == node.inputs[0] &&
         is_along_rows(*sum);
}

/// The value whose largest element is the action that a graph's first output gives; nothing where it is none of a row's elements.
std::optional<std::string> logits_of_actions(const Graph& graph) {
  static const std::set<std::string> kShapes = {"Reshape", "Cast", "Identity", "Squeeze", "Unsqueeze"};
  std::size_t steps_left = graph.nodes.size();  // a graph may go round in a circle
  const Node* node = maker_of(graph, graph.outputs[0].name);
  while (node != nullptr && kShapes.contains(node->operation) && steps_left-- > 0) node = maker_of(graph, node->inputs[0]);
  if (node == nullptr || node->operation != "ArgMax" || !is_along_rows(*node)) return std::nullopt;
  std::string value = node->inputs[0];
  for (; steps_left > 0; --steps_left) {
    node = maker_of(graph, value);
    const bool is_softmax = node != nullptr && (node->operation == "Softmax" || node->operation == "LogSoftmax") && is_along_rows(*node);
    if (node == nullptr || (!is_softmax && !is_normalised_logits(graph, *node))) break;
    value = node->inputs[0];
  }
  return value;
}

/// Leaves the operators that a value is made of, and makes it the output.
void keep_what_makes(const std::string& value, Graph& graph) {
  std::set<std::string> wanted = {value};
  for (std::size_t before = 0; before != wanted.size();) {
    before = wanted.size();
    for (const Node& node : graph.nodes)
      if (wanted.contains(node.outputs[0])) wanted.insert(node.inputs.begin(), node.inputs.end());
  }
  std::erase_if(graph.nodes, [&wanted](const Node& node) { return !wanted.contains(node.outputs[0]); });
  graph.outputs = {{.name = value}};
}

/// PyTorch writes weights that are equal once, and gives them their other names by Identity: such a name becomes weights of its own. So
/// does a Constant.
void name_weights(Graph& graph, OnnxTensorReader& tensors) {
  std::erase_if(graph.nodes, [&](const Node& node) {
    if (node.operation == "Constant" && node.inputs.empty() && node.attributes.size() == 1 && node.attributes[0].name == "value")
      return graph.initializers.emplace(node.outputs[0], tensors.read(node.attributes[0].tensor)).second;
    if (node.operation != "Identity" || node.inputs.size() != 1 || !node.attributes.empty()) return false;
    const auto weights = graph.initializers.find(node.inputs[0]);
    return weights != graph.initializers.end() && graph.initializers.emplace(node.outputs[0], weights->second).second;
  });
}

}  // namespace

OnnxGraph read_onnx_graph(std::string_view bytes, OnnxTensorReader& tensors) {
  Graph graph;
  ProtobufReader reader(bytes);
  while (const auto field = reader.next()) {
    switch (field->number) {
      case 1:
        if (graph.nodes.size() == kMaxNodes) throw BadInput("graph: more operators than any policy that flies");
        graph.nodes.push_back(read_node(field->bytes));
        break;
      case 5: {
        OnnxTensor tensor = tensors.read(field->bytes);
        const std::string name = tensor.name;
        if (!graph.initializers.emplace(name, std::move(tensor)).second) throw BadInput("initializer " + name + ": given twice");
        break;
      }
      case 11:
        graph.inputs.push_back(read_value(field->bytes));
        break;
      case 12:
        graph.outputs.push_back(read_value(field->bytes));
        break;
      case 2:   // name
      case 10:  // doc_string
      case 13:  // value_info
      case 16:  // metadata_props
        break;
      default:
        throw BadInput("graph: field " + std::to_string(field->number) + " is not one that a plain network needs");
    }
  }
  std::erase_if(graph.inputs, [&graph](const Value& value) { return graph.initializers.contains(value.name); });
  check_outputs(graph);
  if (graph.outputs.size() == 3) {
    if (const auto logits = logits_of_actions(graph)) keep_what_makes(*logits, graph);
  }
  name_weights(graph, tensors);
  return graph;
}

}  // namespace earshot::freeze
