#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"

namespace earshot::n2k {

/// Which of several devices a quantity is taken from. Empty: any, but one at a time.
struct SourceChoice {
  std::optional<Name> name;
  std::optional<std::uint8_t> instance;  ///< of those messages that have one (pressure, temperature, battery, rudder)
};

/// Where a message came from.
struct Origin {
  std::uint32_t pgn = 0;
  std::uint8_t address = kNullAddress;
  std::optional<std::uint8_t> instance;
};

/// Lets the messages of one device pass, so that two of a kind are never mixed. Without a choice the first that is heard is the one, until
/// it has been silent for `timeout`; it is known by its NAME, once that is heard, whatever address it moves to.
class SourceGate {
 public:
  SourceGate() = default;
  explicit SourceGate(const SourceChoice& choice) : choice_(choice) {}

  [[nodiscard]] bool admits(const Origin& origin, const Directory& directory, Time now, Duration timeout);

 private:
  struct Holder {
    Origin origin;
    std::optional<Name> name;
    Time last;
  };
  [[nodiscard]] static bool is_same(const Holder& holder, const Origin& origin, std::optional<Name> name);

  SourceChoice choice_;
  std::optional<Holder> holder_;
};

}  // namespace earshot::n2k
