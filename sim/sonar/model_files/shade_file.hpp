#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "firmware/core/units.hpp"
#include "firmware/host/file/output_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar::model_files {

/// How the title of a shade file begins tells whose it is.
inline constexpr host::OutputKind kShadeOutput{"a shade file of Earshot", {}, "Earshot, "};

enum class ShadeLayout : std::uint8_t {
  kDouble,  ///< of the Acoustics Toolbox of 2023 and 2024: ranges, bearing and source in double precision
  kSingle,  ///< of older ones, which arlpy reads: in single precision
};

struct ShadeSource {
  std::string title;
  Hertz frequency;
  Meters depth;
};

/// Writes the complex pressure of a field as a shade file (.shd) of the Acoustics Toolbox, whole or not at all.
///
/// The phase is that of the Acoustics Toolbox, -exp(-i k r) / r about a source in free space: minus the conjugate of the field's pressure,
/// whose factor exp(i k0 r) is put back.
/// @param field  with pressure; NaN stands where there is no water
/// Throws host::BadInput naming the file.
/// Source: the files that the Acoustics Toolbox writes and its readers. Oracle: ShadeFile.*
void write_shade(const std::filesystem::path& path, const SonarField& field, const ShadeSource& source, ShadeLayout layout);

}  // namespace earshot::sonar::model_files
