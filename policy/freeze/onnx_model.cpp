#include "policy/freeze/onnx_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/onnx/onnx_graph.hpp"
#include "policy/freeze/onnx/onnx_tensor.hpp"
#include "policy/freeze/onnx/protobuf.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;
using Graph = OnnxGraph;
using Node = OnnxNode;
using Tensor = OnnxTensor;
using Attribute = OnnxAttribute;

constexpr std::string_view kRemedy = ": write the logits alone (earshot.gym.sb3.export_onnx does), or freeze the model's .zip";

// TensorProto.DataType
constexpr std::uint64_t kFloat = 1;
constexpr std::uint64_t kDouble = 11;

/// One observation goes in, one row of logits comes out, and nothing between is unknown.
void check_is_network(const Graph& graph) {
  if (graph.inputs.size() != 1 || graph.outputs.size() != 1) {
    throw BadInput("graph: not one input (observation) and one output (logits) but " + std::to_string(graph.inputs.size()) + " and " +
                   std::to_string(graph.outputs.size()) + std::string(kRemedy));
  }
  static const std::set<std::string> kKnown = {"Gemm",     "MatMul", "Add", "Tanh", "Relu", "Flatten",
                                               "Identity", "Cast",   "Sub", "Div",  "Mul",  "BatchNormalization"};
  for (const Node& node : graph.nodes) {
    if (kKnown.contains(node.operation)) continue;
    throw BadInput("operator " + node.operation + " is unknown; Gemm, MatMul, Add, Tanh and Relu fly" + std::string(kRemedy));
  }
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

/// scale x + shift, element by element; one number is for all elements.
struct Normalisation {
  std::string operation;
  std::vector<double> scale;
  std::vector<double> shift;
};

/// The numbers of a row [size], or [1 x size].
std::vector<double> row(const Graph& graph, const Node& node, std::size_t input) {
  const auto found = graph.initializers.find(node.inputs[input]);
  if (found == graph.initializers.end()) throw BadInput("operator " + node.operation + ": its numbers are not in the file");
  const Tensor& tensor = found->second;
  if (!tensor.shape.empty() && tensor.shape.back() != tensor.values.size())
    throw BadInput("operator " + node.operation + ": numbers of another shape");
  return {tensor.values.begin(), tensor.values.end()};
}

/// (x - mean) / sqrt(variance + epsilon) * scale + shift. Source: ONNX, operator BatchNormalization.
Normalisation batch_normalisation(const Graph& graph, const Node& node) {
  double epsilon = 1e-5;
  for (const Attribute& attribute : node.attributes) {
    if (attribute.name == "epsilon") epsilon = static_cast<double>(attribute.real);
    const bool is_inference = attribute.name == "training_mode" && attribute.integer == 0;
    if (attribute.name == "epsilon" || attribute.name == "momentum" || is_inference) continue;
    throw BadInput("operator BatchNormalization: attribute " + attribute.name + " is not as a trained network has it");
  }
  if (node.inputs.size() != 5) throw BadInput("operator BatchNormalization: without its four rows of numbers");
  Normalisation step{.operation = node.operation, .scale = row(graph, node, 1), .shift = row(graph, node, 2)};
  const std::vector<double> mean = row(graph, node, 3);
  const std::vector<double> variance = row(graph, node, 4);
  const std::size_t size = step.scale.size();
  if (step.shift.size() != size || mean.size() != size || variance.size() != size)
    throw BadInput("operator BatchNormalization: rows that differ in length");
  for (std::size_t i = 0; i < size; ++i) {
    step.scale[i] /= std::sqrt(variance[i] + epsilon);
    step.shift[i] -= mean[i] * step.scale[i];
  }
  return step;
}

/// What normalises observations before the first layer; nothing for another operator.
std::optional<Normalisation> normalisation(const Graph& graph, const Node& node) {
  if (node.operation == "BatchNormalization") return batch_normalisation(graph, node);
  const bool commutes = node.operation == "Add" || node.operation == "Mul";
  if (!commutes && node.operation != "Sub" && node.operation != "Div") return std::nullopt;
  if (node.inputs.size() != 2 || !node.attributes.empty()) throw BadInput("operator " + node.operation + ": not as a normalisation has it");
  const std::vector<double> numbers = row(graph, node, commutes && graph.initializers.contains(node.inputs[0]) ? 0 : 1);
  Normalisation step{
      .operation = node.operation, .scale = std::vector<double>(numbers.size(), 1.0), .shift = std::vector<double>(numbers.size(), 0.0)};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (node.operation == "Add") step.shift[i] = numbers[i];
    if (node.operation == "Sub") step.shift[i] = -numbers[i];
    if (node.operation == "Mul") step.scale[i] = numbers[i];
    if (node.operation == "Div") step.scale[i] = 1.0 / numbers[i];
  }
  return step;
}

/// Gives the first layer weights that do what the normalisations before it did, each rounded once to a float.
///
///   w' = w a,   b' = b + sum w c,   of all normalisations together a x + c
void fold_in(const std::vector<Normalisation>& steps, DenseLayer& layer) {
  if (steps.empty()) return;
  std::vector<double> scale(layer.inputs, 1.0);
  std::vector<double> shift(layer.inputs, 0.0);
  for (const Normalisation& step : steps) {
    if (step.scale.size() != 1 && step.scale.size() != layer.inputs)
      throw BadInput("operator " + step.operation + ": not as many numbers as the observation has");
    for (std::size_t i = 0; i < layer.inputs; ++i) {
      const std::size_t at = step.scale.size() == 1 ? 0 : i;
      scale[i] *= step.scale[at];
      shift[i] = shift[i] * step.scale[at] + step.shift[at];
      if (!std::isfinite(scale[i]) || !std::isfinite(shift[i]))
        throw BadInput("operator " + step.operation + ": divides by zero or overflows");
    }
  }
  for (std::size_t o = 0; o < layer.outputs; ++o) {
    double bias = static_cast<double>(layer.bias[o]);
    for (std::size_t i = 0; i < layer.inputs; ++i) {
      float& weight = layer.weights[o * layer.inputs + i];
      bias += static_cast<double>(weight) * shift[i];
      weight = static_cast<float>(static_cast<double>(weight) * scale[i]);
    }
    layer.bias[o] = static_cast<float>(bias);
  }
}

std::optional<policy::Activation> activation_of(const Node& node) {
  if (node.inputs.size() != 1 || !node.attributes.empty()) return std::nullopt;
  if (node.operation == "Tanh") return policy::Activation::kTanh;
  if (node.operation == "Relu") return policy::Activation::kRelu;
  return std::nullopt;
}

/// Puts together the layers of a graph from its operators, one after the other.
class ActorReader {
 public:
  explicit ActorReader(const Graph& graph) : graph_(graph) {}

  void take(const Node& node) {
    const std::string& operation = node.operation;
    if (actor_.layers.empty() && is_without_effect(node, graph_.inputs[0].type)) return;
    if (actor_.layers.empty()) {
      if (const auto step = normalisation(graph_, node)) return normalisations_.push_back(*step);
    }
    if (expect_ == Expect::kLayer && operation == "Gemm") {
      actor_.layers.push_back(gemm(graph_, node));
      expect_ = Expect::kActivation;
    } else if (expect_ == Expect::kLayer && operation == "MatMul") {
      actor_.layers.push_back(matmul(graph_, node));
      expect_ = Expect::kBias;
    } else if (expect_ == Expect::kBias && operation == "Add") {
      actor_.layers.back().bias = added(graph_, node);
      expect_ = Expect::kActivation;
    } else if (const auto activation = activation_of(node); expect_ == Expect::kActivation && activation) {
      note(*activation);
      expect_ = Expect::kLayer;
    } else {
      throw BadInput("graph: operator " + operation + " where a network of dense layers with tanh or ReLU between has none");
    }
  }

  TrainedActor finished() {
    if (expect_ != Expect::kActivation) throw BadInput("graph: does not end with a dense layer");
    for (const DenseLayer& layer : actor_.layers) {
      if (layer.bias.size() != layer.outputs) throw BadInput("graph: a bias that does not fit its weights");
    }
    check_chain(actor_);
    fold_in(normalisations_, actor_.layers.front());
    actor_.activation = activation_.value_or(policy::Activation::kTanh);
    return actor_;
  }

 private:
  enum class Expect : std::uint8_t { kLayer, kBias, kActivation };

  void note(policy::Activation activation) {
    if (activation_.value_or(activation) != activation)
      throw BadInput("graph: tanh after one layer and ReLU after another; one of them flies");
    activation_ = activation;
  }

  const Graph& graph_;
  Expect expect_ = Expect::kLayer;
  TrainedActor actor_;
  std::vector<Normalisation> normalisations_;
  std::optional<policy::Activation> activation_;
};

TrainedActor actor_from(const Graph& graph) {
  check_is_network(graph);
  ActorReader reader(graph);
  for (const Node* node : chain_of(graph)) reader.take(*node);
  return reader.finished();
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
      actor = actor_from(read_onnx_graph(field->bytes, tensors));
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
