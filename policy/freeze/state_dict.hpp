#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace earshot::freeze {

struct Tensor {
  std::vector<std::size_t> shape;
  std::vector<float> values;  ///< row-major
};
using StateDict = std::map<std::string, Tensor>;

/// Reads a PyTorch state_dict as torch.save writes it since 1.6: a zip archive of a pickle and raw storages. float32 and contiguous only;
/// nothing in the file is executed. Throws host::BadInput for anything else.
[[nodiscard]] StateDict read_state_dict(std::string_view bytes);

}  // namespace earshot::freeze
