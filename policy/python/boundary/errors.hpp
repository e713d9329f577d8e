#pragma once

namespace earshot::python {

/// Makes host::BadInput, whoever throws it, earshot.errors.BadInput.
void add_errors();

}  // namespace earshot::python
