#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Tables and beliefs in earshot._core: `Tables` and `BeliefState`, which earshot/_core.pyi describes.
void add_belief(pybind11::module_& module);

}  // namespace earshot::python
