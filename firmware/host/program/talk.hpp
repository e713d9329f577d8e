#pragma once

#include <cstdint>
#include <iosfwd>

namespace earshot::program {

/// How much a program says: errors alone (--quiet), what it did, or every setting too (--verbose).
enum class Talk : std::uint8_t { kQuiet, kNormal, kVerbose };

[[nodiscard]] Talk talk();
void set_talk(Talk talk);

/// Where a program says what it did: standard output; nowhere with --quiet.
[[nodiscard]] std::ostream& print();

/// Where a program says what only --verbose shows: standard error; nowhere otherwise.
[[nodiscard]] std::ostream& detail();

}  // namespace earshot::program
