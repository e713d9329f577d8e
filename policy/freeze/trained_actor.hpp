#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/policy/network.hpp"

namespace earshot::freeze {

/// output = weights * input + bias.
struct DenseLayer {
  std::size_t inputs = 0;
  std::size_t outputs = 0;
  std::vector<float> weights;  ///< row-major [outputs x inputs]
  std::vector<float> bias;     ///< [outputs]
};

/// The actor of a policy that was trained elsewhere: dense layers with the activation after each but the last, which gives the logits.
struct TrainedActor {
  std::vector<DenseLayer> layers;
  policy::Activation activation = policy::Activation::kTanh;
  std::optional<std::string> search;              ///< text of the search description that the file carries (policy/description)
  std::vector<std::filesystem::path> data_files;  ///< that hold weights of it, besides the model itself
};

/// Throws host::BadInput unless each layer's inputs are the outputs of the one before.
void check_chain(const TrainedActor& actor);

}  // namespace earshot::freeze
