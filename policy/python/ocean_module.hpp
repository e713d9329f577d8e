#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// The ocean and its sound in earshot._core: the class `Ocean` and the function `radial`, which earshot/_core.pyi describes.
void add_ocean(pybind11::module_& module);

}  // namespace earshot::python
