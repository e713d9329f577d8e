#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <utility>
#include <vector>

namespace earshot::python {

/// The vector becomes the array's memory.
template <class Number>
pybind11::array_t<Number> array_of(std::vector<Number>&& values, const std::vector<pybind11::ssize_t>& shape) {
  auto owned = std::make_unique<std::vector<Number>>(std::move(values));
  const Number* const data = owned->data();
  const pybind11::capsule owner(owned.release(), [](void* vector) { delete static_cast<std::vector<Number>*>(vector); });
  return pybind11::array_t<Number>(shape, data, owner);
}

}  // namespace earshot::python
