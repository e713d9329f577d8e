#pragma once

#include <string>
#include <string_view>

#include "policy/freeze/trained_actor.hpp"

namespace earshot::freeze {

/// Whether the bytes of a file are a model trained elsewhere (a zip archive, or a file called .onnx) rather than a checkpoint.
[[nodiscard]] bool is_foreign_model(std::string_view bytes, const std::string& file);

/// Reads a zip of Stable-Baselines3, or else an ONNX model, whose weights may stand in files beside it. Throws host::BadInput, one line
/// that begins with `file`, whatever the bytes are. Oracle: ModelFuzz.*
[[nodiscard]] TrainedActor read_model(std::string_view bytes, const std::string& file);

/// Bytes that may hold anything as one line of printable characters, cut at a few hundred.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace earshot::freeze
