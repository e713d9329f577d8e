#include "policy/python/boundary/errors.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>

#include "firmware/host/file/bad_input.hpp"
#include "policy/python/boundary/checked.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;

py::object bad_input() {
  return py::module_::import("earshot.errors").attr("BadInput");
}

}  // namespace

void add_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const BadArgument& bad) {
      const py::object type = bad_input();
      const py::object error = type(bad.what(), py::arg("key") = bad.name(), py::arg("value") = bad.value());
      PyErr_SetObject(type.ptr(), error.ptr());
    } catch (const host::BadInput& bad) {
      py::set_error(bad_input(), bad.what());
    }
  });
}

}  // namespace earshot::python
