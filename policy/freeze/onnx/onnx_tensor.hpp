#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earshot::freeze {

/// Weights of an ONNX model.
struct OnnxTensor {
  std::string name;
  std::vector<std::uint64_t> shape;
  std::vector<float> values;  ///< row-major
};

/// Reads the weights of one model: float32, in the model itself or in files beside it ("external data").
///
/// A model names such a file relative to its own folder, and that is where it must be: a path that leads elsewhere, also by a link, is
/// refused before anything is opened, and so is what is no regular file or reaches beyond the file's end.
/// Source: onnx.proto3, TensorProto; ONNX's ExternalData.md. Deviation: `checksum` is not looked at, other keys than those five are
/// refused. Oracle: OnnxTensor.*
class OnnxTensorReader {
 public:
  /// @param folder  the model's
  explicit OnnxTensorReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// @param bytes  a TensorProto. Throws host::BadInput, naming the tensor.
  [[nodiscard]] OnnxTensor read(std::string_view bytes);
  /// The files that were read so far, in the order of the tensors, each once.
  [[nodiscard]] const std::vector<std::filesystem::path>& data_files() const { return data_files_; }

 private:
  void fill_from_file(const std::vector<std::string_view>& entries, OnnxTensor& tensor);

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> data_files_;
  std::uint64_t values_left_ = std::uint64_t{1024} * 1024;  ///< of all that are read from files; far more than the networks that fly
};

}  // namespace earshot::freeze
