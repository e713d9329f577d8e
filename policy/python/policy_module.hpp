#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Frozen policies in earshot._core: `FrozenPolicy`, which earshot/_core.pyi describes.
void add_policy(pybind11::module_& module);

}  // namespace earshot::python
