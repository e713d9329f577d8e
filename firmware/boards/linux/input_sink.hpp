#pragma once

#include "firmware/core/time.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// Takes what the bus brought, one by one in the order in which it came.
class InputSink {
 public:
  InputSink() = default;
  virtual ~InputSink() = default;
  InputSink(const InputSink&) = delete;
  InputSink& operator=(const InputSink&) = delete;

  /// @param now  when it was taken from the bus
  virtual void take(Time now, const runtime::Navigation& navigation) = 0;
  virtual void take(Time now, const runtime::SnrEstimate& estimate) = 0;
  virtual void take(Time now, runtime::OperatorCommand command) = 0;
};

}  // namespace earshot::board
