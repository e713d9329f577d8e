#pragma once

#include <filesystem>
#include <string_view>

#include "policy/freeze/trained_actor.hpp"

namespace earshot::freeze {

/// Key of the model's metadata_props that says what the policy was trained to search; `earshot.gym.sb3.export_onnx` (policy/python) writes
/// it.
inline constexpr std::string_view kSearchMetadata = "earshot";

/// The actor of an ONNX model: one chain from the one input to the one output (logits), or to what the actions of Stable-Baselines3's
/// documented export are the largest of. It consists of Gemm, or MatMul and Add, with a Tanh, or a Relu, between layers. Before them may
/// stand a Flatten, an Identity or a Cast to float32, which change nothing, and what normalises observations by numbers in the file (Sub,
/// Div, Mul, Add, BatchNormalization): it is folded into the first layer. Weights are float32, in the file or beside it.
/// Throws host::BadInput, naming what it does not know and what to do, for any other operator, attribute or data type.
/// @param folder  the model's: files of weights ("external data") are looked for there and nowhere else
/// Oracle: OnnxModel.HoldsTheWeightsOfTheModelItWasExportedFrom (torch 1.13's exporter)
[[nodiscard]] TrainedActor read_onnx_model(std::string_view bytes, const std::filesystem::path& folder);

}  // namespace earshot::freeze
