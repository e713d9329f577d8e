#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <utility>

namespace earshot::python {

/// Lets Python in while C++ works without it, some twenty times a second: for Ctrl-C, and for who wants to know how far it is.
class Watch {
 public:
  /// @param callback  a callable, or None
  explicit Watch(pybind11::object callback) : callback_(std::move(callback)) {}

  /// @param fraction  of the work that is done
  void operator()(double fraction) {
    constexpr std::chrono::milliseconds kBetween{50};
    const auto now = std::chrono::steady_clock::now();
    if (fraction < 1.0 && now - last_ < kBetween) return;
    last_ = now;
    const pybind11::gil_scoped_acquire with_python;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    if (!callback_.is_none()) callback_(fraction);
  }

 private:
  pybind11::object callback_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace earshot::python
