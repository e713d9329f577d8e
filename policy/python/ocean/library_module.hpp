#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Field libraries in earshot._core: `read_library`, which earshot/_core.pyi describes.
void add_libraries(pybind11::module_& module);

}  // namespace earshot::python
