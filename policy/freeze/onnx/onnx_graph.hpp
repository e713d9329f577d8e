#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "policy/freeze/onnx/onnx_tensor.hpp"

namespace earshot::freeze {

struct OnnxAttribute {
  std::string name;
  float real = 0.0F;
  std::int64_t integer = 0;
  std::vector<std::int64_t> integers;
  std::string_view tensor;  ///< TensorProto, in the model's bytes
};

struct OnnxNode {
  std::string operation;
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;  ///< one
  std::vector<OnnxAttribute> attributes;
};

/// An input or output of the graph.
struct OnnxValue {
  std::string name;
  std::uint64_t type = 0;  ///< of a tensor's elements; 0: nothing says it
};

struct OnnxGraph {
  std::vector<OnnxNode> nodes;
  std::map<std::string, OnnxTensor> initializers;
  std::vector<OnnxValue> inputs;  ///< those that are no weights
  std::vector<OnnxValue> outputs;
};

/// The graph of a model, in which every value has one origin.
///
/// Of the export that Stable-Baselines3 documents (actions, values, log-probabilities) it is the part that the actions are made of: from
/// the observation to the logits whose largest is the action. What else is computed of logits is left out, and so is the critic. Weights
/// that a graph names twice (Identity), or writes as a Constant, are initializers like any other.
///
/// Throws host::BadInput for what is no graph, a value that two operators give, and weights that are not plain float32.
/// @param bytes  a GraphProto, which must outlive the graph  Source: onnx.proto3 (ONNX 1.17)
[[nodiscard]] OnnxGraph read_onnx_graph(std::string_view bytes, OnnxTensorReader& tensors);

}  // namespace earshot::freeze
