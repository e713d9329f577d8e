#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "policy/baselines/searcher.hpp"

namespace earshot::python {

/// A searcher that is written in Python: a callable, or an object with `choose`, and where it has them `begin` and `declares_found`.
/// Called without Python's lock. Throws pybind11::error_already_set for what Python raises.
class PythonSearcher : public baselines::Searcher {
 public:
  /// @param bound  (begin or None, choose, declares_found or None), callables
  PythonSearcher(std::string name, pybind11::tuple bound, std::size_t actions);
  PythonSearcher(const PythonSearcher&) = delete;
  PythonSearcher& operator=(const PythonSearcher&) = delete;
  ~PythonSearcher() override;

  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const baselines::DecisionInput& input) override;
  [[nodiscard]] std::optional<bool> declares_found() const override;

 private:
  std::string name_;
  pybind11::tuple bound_;
  std::size_t actions_;
  std::uint32_t step_ = 0;
  bool declares_ = false;  ///< whether it says so at all
};

}  // namespace earshot::python
