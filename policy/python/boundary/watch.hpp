#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <utility>

namespace earshot::python {

/// Lets Python in while C++ works without it, some twenty times a second: for Ctrl-C, and for who wants to know how far it is.
class Watch {
 public:
  /// @param callback  a callable, or None
  explicit Watch(pybind11::object callback) : callback_(std::move(callback)) {}

  /// @param fraction  of the work that is done
  void operator()(double fraction) {
    if (fraction < 1.0 && !is_time()) return;
    const pybind11::gil_scoped_acquire with_python;
    let_signals_in();
    if (!callback_.is_none()) callback_(fraction);
  }

  /// Of work whose share nobody knows, or nobody is told.
  void operator()() {
    if (!is_time()) return;
    const pybind11::gil_scoped_acquire with_python;
    let_signals_in();
  }

 private:
  bool is_time() {
    constexpr std::chrono::milliseconds kBetween{50};
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < kBetween) return false;
    last_ = now;
    return true;
  }

  static void let_signals_in() {
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }

  pybind11::object callback_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Does work that has threads of its own on yet another one, while the thread that signals come to lets Python in.
/// @param work  gets a function that takes the share that is done, from any thread
/// Throws what the work throws. What lets it end early, such as Ctrl-C, is thrown when the work has ended: at the next share that it
/// reports.
template <class Work>
auto beside(Watch& watch, const Work& work) {
  struct Stopped {};
  constexpr std::chrono::milliseconds kBetween{50};
  std::atomic<double> share{0.0};
  std::atomic<bool> is_stopped{false};
  auto result = std::async(std::launch::async, [&] {
    return work([&](double reported) {
      if (is_stopped) throw Stopped();
      share = reported;
    });
  });
  try {
    while (result.wait_for(kBetween) != std::future_status::ready) watch(share);
    watch(share);
  } catch (...) {
    is_stopped = true;
    result.wait();
    throw;
  }
  return result.get();
}

}  // namespace earshot::python
