#pragma once

#include <optional>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// What decides: this process's own runtime, or one on a microcontroller beside this computer.
class Core {
 public:
  Core() = default;
  virtual ~Core() = default;
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  /// As runtime::Runtime's. @return nothing: what becomes of an order the next step's acknowledgements say
  virtual std::optional<messages::CommandOutcome> take(const messages::Input& input) = 0;
  [[nodiscard]] virtual runtime::Outputs step(Time now) = 0;
  [[nodiscard]] virtual const config::Mission& mission() const = 0;
};

/// This process's own.
class OwnCore final : public Core {
 public:
  /// @param runtime  must outlive it
  explicit OwnCore(runtime::Runtime& runtime) : runtime_(runtime) {}

  std::optional<messages::CommandOutcome> take(const messages::Input& input) override { return runtime_.take(input); }
  [[nodiscard]] runtime::Outputs step(Time now) override { return runtime_.step(now); }
  [[nodiscard]] const config::Mission& mission() const override { return runtime_.mission(); }

 private:
  runtime::Runtime& runtime_;
};

}  // namespace earshot::board
