#pragma once

#include <string_view>

#include "policy/freeze/trained_actor.hpp"

namespace earshot::freeze {

/// Key of the model's metadata_props that says what the policy was trained to search; `earshot_gym.sb3.export_onnx` (policy/python) writes
/// it.
inline constexpr std::string_view kSearchMetadata = "earshot";

/// The actor of an ONNX model: one chain from the one input to the one output (logits) of Gemm, or MatMul and Add, with a Tanh between
/// layers; a Flatten or Identity may stand first. Weights are float32 and in the file. Throws host::BadInput, naming what it does
/// not know, for any other operator, attribute or data type. Oracle: OnnxModel.HoldsTheWeightsOfTheModelItWasExportedFrom (torch 1.13's
/// exporter)
[[nodiscard]] TrainedActor read_onnx_model(std::string_view bytes);

}  // namespace earshot::freeze
