#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Evaluation in earshot._core: `evaluate` and `baselines`, which earshot/_core.pyi describes.
void add_evaluation(pybind11::module_& module);

}  // namespace earshot::python
