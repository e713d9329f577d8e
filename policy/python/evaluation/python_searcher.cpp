#include "policy/python/evaluation/python_searcher.hpp"

#include <utility>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;

enum Bound : std::size_t { kBegin, kChoose, kDeclaresFound };

}  // namespace

PythonSearcher::PythonSearcher(std::string name, py::tuple bound, std::size_t actions)
    : name_(std::move(name)), bound_(std::move(bound)), actions_(actions), declares_(!bound_[kDeclaresFound].is_none()) {}

PythonSearcher::~PythonSearcher() {
  const py::gil_scoped_acquire with_python;
  bound_.release().dec_ref();
}

void PythonSearcher::begin(Pcg32 random) {
  step_ = 0;
  const py::gil_scoped_acquire with_python;
  if (!bound_[kBegin].is_none()) bound_[kBegin](random.next());
}

std::size_t PythonSearcher::choose(const baselines::DecisionInput& input) {
  const py::gil_scoped_acquire with_python;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const py::tuple position = py::make_tuple(input.position.north.value, input.position.east.value);
  const py::object answer = bound_[kChoose](position, input.reception.snr.value, input.reception.too_faint, step_);
  ++step_;
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(answer.ptr()));
  const long long action = index ? PyLong_AsLongLong(index.ptr()) : -1;
  if (PyErr_Occurred() != nullptr) PyErr_Clear();
  if (!index || action < 0 || static_cast<std::size_t>(action) >= actions_)
    throw host::BadInput("policies: " + name_ + " must choose a whole number, 0 to " + std::to_string(actions_ - 1) + ", and chose " +
                         std::string(py::str(py::repr(answer))));
  return static_cast<std::size_t>(action);
}

std::optional<bool> PythonSearcher::declares_found() const {
  if (!declares_) return std::nullopt;
  if (step_ == 0) return false;  // it has chosen nothing yet
  const py::gil_scoped_acquire with_python;
  const py::object answer = bound_[kDeclaresFound]();
  if (!py::isinstance<py::bool_>(answer))
    throw host::BadInput("policies: declares_found of " + name_ + " must give True or False, and gave " +
                         std::string(py::str(py::repr(answer))));
  return answer.cast<bool>();
}

}  // namespace earshot::python
