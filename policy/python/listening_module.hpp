#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Detections in sound in earshot._core: `listen_to_files`, the class `SoundStream`, and selection tables, as earshot/_core.pyi describes
/// them.
void add_listening(pybind11::module_& module);

}  // namespace earshot::python
