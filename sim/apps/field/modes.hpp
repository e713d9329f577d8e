#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "sim/apps/field/arguments.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/radial_case.hpp"
#include "sim/ocean/section.hpp"
#include "sim/parallel/rank_session.hpp"

namespace earshot::field {

/// What every rank knows to be wrong; rank 0 says it.
class BadStart : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The ocean of an environment file. What the file says of a search is read too and left out: one file serves all programs, and a mistake
/// in it is told by each.
[[nodiscard]] ocean::Environment environment_in(const std::filesystem::path& path);

/// What ENVIRONMENT states, its source at the depth that the options choose. Throws host::BadInput where a file has several and they choose
/// none.
[[nodiscard]] ocean::RadialCase case_of(const FieldArguments& arguments);

/// "fin whale ocean, source of 20 Hz at 36 m"; "... of 15 to 30 Hz ..." where a band is computed.
[[nodiscard]] std::string ocean_to_string(const ocean::Environment& environment, const ocean::Band& band);

/// Says what SNR means where the input is a file that names no levels.
void print_level_note(const FieldArguments& arguments);

/// Says on standard error what the result leans on and does not hold; nothing where there is nothing to say.
void warn(const std::optional<ocean::UnmeasuredWater>& water);
void warn(const std::string& what);
/// @param doubt  sonar::doubt_of
void warn_of_doubt(const std::optional<std::string>& doubt);

/// Each computes, writes and says in a few lines on standard output what it did; throws what is wrong in one line. Libraries are shared
/// among ranks; the others are one process's work.
void write_radial(const FieldArguments& arguments);
void write_fan(const FieldArguments& arguments);
void write_library(const FieldArguments& arguments, parallel::RankSession& session);

}  // namespace earshot::field
