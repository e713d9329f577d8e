#pragma once

#include <pybind11/numpy.h>

namespace earshot::python {

inline constexpr int kRowsAligned = int{pybind11::array::c_style} | int{pybind11::detail::npy_api::NPY_ARRAY_ALIGNED_};

/// An array that Python gives, row after row, each number where the processor wants it: NumPy copies one that is not so, such as a field of
/// packed records.
/// @tparam kMore  pybind11::array::forcecast: numbers of another type become these, with what that loses
template <class Number, int kMore = 0>
using GivenArray = pybind11::array_t<Number, kRowsAligned | kMore>;

}  // namespace earshot::python
