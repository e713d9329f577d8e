#pragma once

#include <cassert>
#include <cstdint>

namespace earshot {

/// What the caller should do about a failure; the finer cause is a counter beside the code that found it.
enum class Status : std::uint8_t {
  kOk,           ///< go on
  kOutOfRange,   ///< a value lies outside its stated range (or is not finite): refuse it
  kMalformed,    ///< bytes do not follow their format: drop them
  kUnsupported,  ///< well formed, but of a version or kind this build does not know: refuse it
  kCorrupt,      ///< a checksum or signature does not match: do not use any of it
  kFull,         ///< a fixed capacity is used up: drop, count, go on
  kNotReady,     ///< nothing to give yet: call again later
  kStale,        ///< the last value is too old to act upon: fall back
};

/// A value or the Status that says why there is none. Neither allocates nor throws.
template <class T>
class [[nodiscard]] Result {
 public:
  constexpr Result(T value) : value_(value), status_(Status::kOk) {}  // NOLINT(google-explicit-constructor): reads as return
  constexpr Result(Status status) : status_(status) { assert(status != Status::kOk); }  // NOLINT(google-explicit-constructor)

  [[nodiscard]] constexpr bool ok() const { return status_ == Status::kOk; }
  [[nodiscard]] constexpr Status status() const { return status_; }
  [[nodiscard]] constexpr const T& value() const {
    assert(ok());
    return value_;
  }

 private:
  T value_{};
  Status status_;
};

}  // namespace earshot
