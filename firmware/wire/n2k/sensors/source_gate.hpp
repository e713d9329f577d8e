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

/// How a device stands to a quantity.
enum class SourceStatus : std::uint8_t {
  kHolds,          ///< the quantity is taken from it
  kIsFree,         ///< from nobody now, and it may be taken from this one
  kHeldByAnother,  ///< from another device
  kNotChosen,      ///< the mission names another one
};

/// Lets the messages of one device pass, so that two of a kind are never mixed. Without a choice the first that has a value is the one,
/// until it has given none for `handover`; it is known by its NAME, once that is heard, whatever address it moves to.
class SourceGate {
 public:
  SourceGate() = default;
  explicit SourceGate(const SourceChoice& choice) : choice_(choice) {}

  [[nodiscard]] SourceStatus status_of(const Origin& origin, const Directory& directory, Time now, Duration handover) const;
  /// It has given a value. Only for one that holds, or where nobody does.
  void hold(const Origin& origin, const Directory& directory, Time now);

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
