#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// The files of other propagation models in earshot._core: `write_shade` and `write_tl_grid`, which earshot/_core.pyi describes.
void add_model_files(pybind11::module_& module);

}  // namespace earshot::python
