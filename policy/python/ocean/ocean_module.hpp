#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Oceans in earshot._core: the classes `Ocean` and `RadialCase`, which earshot/_core.pyi describes.
void add_ocean(pybind11::module_& module);

}  // namespace earshot::python
