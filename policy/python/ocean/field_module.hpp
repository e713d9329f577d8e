#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Sound in earshot._core: the class `SoundRequest` and the functions `radial` and `fan`, which earshot/_core.pyi describes.
void add_fields(pybind11::module_& module);

}  // namespace earshot::python
