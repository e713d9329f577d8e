#pragma once

#include <pybind11/pybind11.h>

namespace earshot::python {

/// Journals in earshot._core: `journal_records` and `journal_fields`, which earshot/_core.pyi describes.
void add_journal(pybind11::module_& module);

}  // namespace earshot::python
