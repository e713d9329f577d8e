#include "policy/python/policy_module.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "policy/python/boundary/given_array.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using Floats = py::array_t<float, py::array::c_style>;

/// A `.policy` file as the vehicle runs it. Its signature is not checked: a desk may look at any policy.
class FrozenPolicy {
 public:
  explicit FrozenPolicy(const std::filesystem::path& file)
      : FrozenPolicy(host::read_bytes(file, {"a .policy file", policy::max_serialised_size()}), file) {}
  /// @param name  of the policy, for what is said of it
  FrozenPolicy(std::vector<std::uint8_t> bytes, const std::filesystem::path& name)
      : bytes_(std::move(bytes)), policy_(host::policy_from(bytes_, name)) {}

  [[nodiscard]] py::bytes state() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }
  static FrozenPolicy from_state(const std::string& bytes) { return {{bytes.begin(), bytes.end()}, "the pickled policy"}; }

  [[nodiscard]] Floats logits(const GivenArray<float, py::array::forcecast>& observations) const {
    const std::size_t size = policy_->observation.spec.size();
    if (observations.ndim() != 2 || static_cast<std::size_t>(observations.shape(1)) != size) {
      throw py::value_error("observations: must be of shape [count x " + std::to_string(size) + "]");
    }
    const auto count = static_cast<std::size_t>(observations.shape(0));
    Floats logits(std::vector<py::ssize_t>{observations.shape(0), static_cast<py::ssize_t>(policy_->actions.size())});
    const std::span<float> all(logits.mutable_data(), static_cast<std::size_t>(logits.size()));
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t actions = policy_->actions.size();
      policy::forward(policy_->network, std::span(observations.data(), count * size).subspan(i * size, size),
                      all.subspan(i * actions, actions));
    }
    return logits;
  }

  [[nodiscard]] std::string provenance() const { return {policy_->provenance.begin(), policy_->provenance.end()}; }

 private:
  std::vector<std::uint8_t> bytes_;  ///< of the file
  std::unique_ptr<policy::FrozenPolicy> policy_;
};

}  // namespace

void add_policy(py::module_& module) {
  py::class_<FrozenPolicy>(module, "FrozenPolicy",
                           "A `.policy` file, run with the arithmetic that flies. The signature is not checked.\n\n"
                           "Raises BadInput for a damaged file.")
      .def(py::init<std::filesystem::path>(), py::arg("file"))
      .def(py::pickle([](const FrozenPolicy& policy) { return policy.state(); },
                      [](const py::bytes& bytes) { return FrozenPolicy::from_state(bytes); }))
      .def("logits", &FrozenPolicy::logits, py::arg("observations"), "float32 [count x observation_size] -> [count x action_count]")
      .def_property_readonly("provenance", &FrozenPolicy::provenance, "Lines \"name = value\".");
}

}  // namespace earshot::python
