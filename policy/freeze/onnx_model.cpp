#include "policy/freeze/onnx_model.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/onnx_tensor.hpp"
#include "policy/freeze/protobuf.hpp"

// Field numbers are those of onnx.proto3 (ONNX 1.17), the schema of every version up to it.

namespace earshot::freeze {
namespace {

using host::BadInput;
using Tensor = OnnxTensor;

constexpr std::size_t kMaxNodes = 64;  ///< operators of a graph; the networks that fly have six
constexpr std::string_view kRemedy = ": write the logits alone (earshot_gym.sb3.export_onnx does), or freeze the model's .zip";

// TensorProto.DataType
constexpr std::uint64_t kFloat = 1;
constexpr std::uint64_t kDouble = 11;

struct Attribute {
  std::string name;
  float real = 0.0F;
  std::int64_t integer = 0;
};

Attribute read_attribute(std::string_view bytes) {
  Attribute attribute;
  ProtobufReader reader(bytes);
  while (const auto field = reader.next()) {
    if (field->number == 1) attribute.name = text_of(*field);
    if (field->number == 2) attribute.real = std::bit_cast<float>(static_cast<std::uint32_t>(field->value));
    if (field->number == 3) attribute.integer = static_cast<std::int64_t>(field->value);
  }
  return attribute;
}

struct Node {
  std::string operation;
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  std::vector<Attribute> attributes;
};

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

/// An input or output of the graph.
struct Value {
  std::string name;
  std::uint64_t type = 0;  ///< of a tensor's elements; 0: nothing says it
};

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

struct Graph {
  std::vector<Node> nodes;
  std::map<std::string, Tensor> initializers;
  std::vector<Value> inputs;
  std::vector<Value> outputs;
};

/// One observation goes in, one row of logits comes out, and nothing between is unknown.
void check_is_network(const Graph& graph) {
  if (graph.inputs.size() != 1 || graph.outputs.size() != 1) {
    throw BadInput("graph: not one input (observation) and one output (logits) but " + std::to_string(graph.inputs.size()) + " and " +
                   std::to_string(graph.outputs.size()) + std::string(kRemedy));
  }
  static const std::set<std::string> kKnown = {"Gemm", "MatMul", "Add", "Tanh", "Flatten", "Identity", "Cast"};
  for (const Node& node : graph.nodes) {
    if (!kKnown.contains(node.operation)) {
      throw BadInput("operator " + node.operation + " is unknown; Gemm, MatMul, Add and Tanh fly" + std::string(kRemedy));
    }
  }
}

/// Every value has one origin: chain_of() follows names.
void check_outputs(const Graph& graph) {
  std::set<std::string> given = {graph.inputs[0].name};
  for (const auto& [name, tensor] : graph.initializers) given.insert(name);
  for (const Node& node : graph.nodes) {
    if (given.insert(node.outputs[0]).second) continue;
    throw BadInput("operator " + node.operation + ": its output " + node.outputs[0] + " is the name of another value");
  }
}

/// PyTorch writes weights that are equal once, and gives them their other names by Identity: such a name becomes weights of its own.
void name_equal_weights(Graph& graph) {
  std::erase_if(graph.nodes, [&graph](const Node& node) {
    if (node.operation != "Identity" || node.inputs.size() != 1 || !node.attributes.empty()) return false;
    const auto weights = graph.initializers.find(node.inputs[0]);
    return weights != graph.initializers.end() && graph.initializers.emplace(node.outputs[0], weights->second).second;
  });
}

Graph read_graph(std::string_view bytes, OnnxTensorReader& tensors) {
  Graph graph;
  ProtobufReader reader(bytes);
  while (const auto field = reader.next()) {
    switch (field->number) {
      case 1:
        if (graph.nodes.size() == kMaxNodes) throw BadInput("graph: more operators than any policy that flies");
        graph.nodes.push_back(read_node(field->bytes));
        break;
      case 5: {
        Tensor tensor = tensors.read(field->bytes);
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
  check_is_network(graph);
  check_outputs(graph);
  name_equal_weights(graph);
  return graph;
}

/// The nodes in the order in which they work on the observation.
std::vector<const Node*> chain_of(const Graph& graph) {
  std::vector<const Node*> chain;
  std::string current = graph.inputs[0].name;
  while (current != graph.outputs[0].name && chain.size() < graph.nodes.size()) {
    const Node* next = nullptr;
    for (const Node& node : graph.nodes) {
      if (std::ranges::find(node.inputs, current) == node.inputs.end()) continue;
      if (next != nullptr) throw BadInput("graph: " + current + " goes more than one way");
      next = &node;
    }
    if (next == nullptr) throw BadInput("graph: " + current + " goes nowhere");
    chain.push_back(next);
    current = next->outputs[0];
  }
  if (current != graph.outputs[0].name || chain.size() != graph.nodes.size()) throw BadInput("graph: not one chain from input to output");
  return chain;
}

const Tensor& initializer(const Graph& graph, const Node& node, std::size_t input, std::size_t dimensions) {
  const auto found = input < node.inputs.size() ? graph.initializers.find(node.inputs[input]) : graph.initializers.end();
  if (found == graph.initializers.end()) throw BadInput("operator " + node.operation + ": its weights are not in the file");
  if (found->second.shape.size() != dimensions) throw BadInput("operator " + node.operation + ": weights of another shape");
  return found->second;
}

/// @param transposed  the tensor is [outputs x inputs]; else it is [inputs x outputs]
DenseLayer layer_from(const Tensor& weights, bool transposed) {
  DenseLayer layer;
  layer.outputs = static_cast<std::size_t>(weights.shape[transposed ? 0 : 1]);
  layer.inputs = static_cast<std::size_t>(weights.shape[transposed ? 1 : 0]);
  layer.weights.resize(weights.values.size());
  for (std::size_t o = 0; o < layer.outputs; ++o) {
    for (std::size_t i = 0; i < layer.inputs; ++i) {
      layer.weights[o * layer.inputs + i] = weights.values[transposed ? o * layer.inputs + i : i * layer.outputs + o];
    }
  }
  return layer;
}

DenseLayer gemm(const Graph& graph, const Node& node) {
  bool transposed = false;
  for (const Attribute& attribute : node.attributes) {
    const bool one = (attribute.name == "alpha" || attribute.name == "beta") && attribute.real == 1.0F;
    const bool plain = attribute.name == "transA" && attribute.integer == 0;
    const bool turned = attribute.name == "transB" && (attribute.integer == 0 || attribute.integer == 1);
    if (!one && !plain && !turned) throw BadInput("operator Gemm: attribute " + attribute.name + " is not as a dense layer has it");
    if (turned) transposed = attribute.integer == 1;
  }
  if (node.inputs.size() != 3) throw BadInput("operator Gemm: without a bias");
  DenseLayer layer = layer_from(initializer(graph, node, 1, 2), transposed);
  layer.bias = initializer(graph, node, 2, 1).values;
  return layer;
}

DenseLayer matmul(const Graph& graph, const Node& node) {
  if (node.inputs.size() != 2 || !node.attributes.empty()) throw BadInput("operator MatMul: not as a dense layer has it");
  return layer_from(initializer(graph, node, 1, 2), false);
}

/// Addition commutes: the bias is whichever input is in the file.
std::vector<float> added(const Graph& graph, const Node& node) {
  if (node.inputs.size() != 2 || !node.attributes.empty()) throw BadInput("operator Add: not as a dense layer has it");
  return initializer(graph, node, graph.initializers.contains(node.inputs[0]) ? 0 : 1, 1).values;
}

/// A float32 is the same number as a double, and as itself; what made whole numbers or halves of the observations would change them.
bool is_cast_of_float(const Node& node, std::uint64_t input_type) {
  const bool is_to_float = node.attributes.size() == 1 && node.attributes[0].name == "to" && node.attributes[0].integer == kFloat;
  if (is_to_float && (input_type == kFloat || input_type == kDouble)) return true;
  throw BadInput("operator Cast: only of observations that are float32 (or double) to float32: train on a Box of float32");
}

/// Changes nothing for observations [batch x size].
/// @param input_type  of the graph's input
bool is_without_effect(const Node& node, std::uint64_t input_type) {
  if (node.inputs.size() != 1) return false;
  if (node.operation == "Cast") return is_cast_of_float(node, input_type);
  if (node.operation == "Identity") return node.attributes.empty();
  return node.operation == "Flatten" &&
         std::ranges::all_of(node.attributes, [](const Attribute& a) { return a.name == "axis" && a.integer == 1; });
}

TrainedActor actor_from(const Graph& graph) {
  enum class Expect : std::uint8_t { kLayer, kBias, kTanh } expect = Expect::kLayer;
  TrainedActor actor;
  for (const Node* node : chain_of(graph)) {
    const std::string& operation = node->operation;
    if (actor.layers.empty() && is_without_effect(*node, graph.inputs[0].type)) continue;
    if (expect == Expect::kLayer && operation == "Gemm") {
      actor.layers.push_back(gemm(graph, *node));
      expect = Expect::kTanh;
    } else if (expect == Expect::kLayer && operation == "MatMul") {
      actor.layers.push_back(matmul(graph, *node));
      expect = Expect::kBias;
    } else if (expect == Expect::kBias && operation == "Add") {
      actor.layers.back().bias = added(graph, *node);
      expect = Expect::kTanh;
    } else if (expect == Expect::kTanh && operation == "Tanh" && node->inputs.size() == 1) {
      expect = Expect::kLayer;
    } else {
      throw BadInput("graph: operator " + operation + " where a network of dense layers with tanh between has none");
    }
  }
  if (expect != Expect::kTanh) throw BadInput("graph: does not end with a dense layer");
  for (const DenseLayer& layer : actor.layers) {
    if (layer.bias.size() != layer.outputs) throw BadInput("graph: a bias that does not fit its weights");
  }
  check_chain(actor);
  return actor;
}

/// Whether one of the model's metadata_props is ours; then `search` holds it.
void read_metadata(std::string_view bytes, std::optional<std::string>& search) {
  const auto [key, value] = text_pair_of(bytes);
  if (key != kSearchMetadata) return;
  if (search) throw BadInput("metadata: " + key + " given twice");
  search = value;
}

}  // namespace

TrainedActor read_onnx_model(std::string_view bytes, const std::filesystem::path& folder) {
  OnnxTensorReader tensors(folder);
  std::optional<TrainedActor> actor;
  std::optional<std::string> search;
  ProtobufReader reader(bytes);
  while (const auto field = reader.next()) {
    if (field->number == 7) {
      if (actor) throw BadInput("more than one graph");
      actor = actor_from(read_graph(field->bytes, tensors));
    } else if (field->number == 14) {
      read_metadata(field->bytes, search);
    } else if (field->number == 25) {
      throw BadInput("operators of its own (functions) are not known");
    }
  }
  if (!actor) throw BadInput("not an ONNX model, or cut short");
  actor->search = search;
  actor->data_files = tensors.data_files();
  return *actor;
}

}  // namespace earshot::freeze
