#pragma once

#include <span>

namespace earshot::python {

/// A shared library that is loaded when the first of its functions is called, so that earshot_gym is imported where it is not installed.
class LateLibrary {
 public:
  /// @param names     the first that can be loaded is taken; one without a path is looked for as the linker does
  /// @param sentence  what a person is told where none can: what needs the library, and what to do
  constexpr LateLibrary(std::span<const char* const> names, const char* sentence) : names_(names), sentence_(sentence) {}

  /// Throws netcdf::FileError, which Python sees as BadInput, where the library or the function is not there.
  [[nodiscard]] void* function(const char* name) const;

 private:
  std::span<const char* const> names_;
  const char* sentence_;
};

/// The function `name` of a library, with the type of what its header declares.
template <class Declared>
Declared* late(const LateLibrary& library, const char* name) {
  return reinterpret_cast<Declared*>(library.function(name));
}

}  // namespace earshot::python

/// Defines a function of the library, which loads it when it is first called.
#define EARSHOT_LATE(LIBRARY, RESULT, NAME, PARAMETERS, ARGUMENTS)                          \
  extern "C" RESULT NAME PARAMETERS {                                                       \
    static auto* const function = earshot::python::late<RESULT PARAMETERS>(LIBRARY, #NAME); \
    return function ARGUMENTS;                                                              \
  }
