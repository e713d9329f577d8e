#pragma once

#include <filesystem>
#include <string>

namespace earshot::host {

/// Environment variable that names the folder of all that ships, laid out as the source tree is.
inline constexpr const char* kDataVariable = "EARSHOT_DATA";

/// A file or folder that ships with the running program. Looked for in this order, and the first that is there is taken:
///   1. in the folder that EARSHOT_DATA names; where it is set, nowhere else, so that a wrong one is noticed;
///   2. in the installation: share/earshot beside the program's bin;
///   3. in the source tree that the program was built in, where it stands in build/PRESET/bin.
/// @param relative  as in the source tree: "sim/ocean/environments/munk_flat.toml"
/// @throws BadInput when it is in none, naming where it was looked for.
/// Oracle: Shipped.*
[[nodiscard]] std::filesystem::path shipped(const std::filesystem::path& relative);

/// The same for a program's folder and a variable's value, an empty one for a variable that is not set.
[[nodiscard]] std::filesystem::path shipped(const std::filesystem::path& relative, const std::filesystem::path& bin,
                                            const std::string& data_variable);

/// What to say behind "no such file" of a path that a document names as the source tree does, while the file lies elsewhere:
/// "; the one that ships is /usr/share/earshot/policy/worlds/noisy_4db.toml". Empty when none ships under that name, and of a whole path.
/// It is said and not opened: whoever means a file of his own must not get another.
[[nodiscard]] std::string shipped_instead(const std::filesystem::path& missing);

/// A library that the running program loads, or hands to one that it starts: beside the program, as it is built, or in lib/earshot beside
/// its bin, as it is installed. No variable moves it: what runs in a program is no data.
/// @return an empty path when it is in neither.
[[nodiscard]] std::filesystem::path shipped_library(const std::string& name);

/// The folder of the running program.
[[nodiscard]] std::filesystem::path own_folder();

}  // namespace earshot::host
