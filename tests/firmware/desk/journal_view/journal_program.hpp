#pragma once

#include <filesystem>

namespace earshot::journal {

/// The program that these tests run.
inline const std::filesystem::path kProgram = std::filesystem::path(EARSHOT_BIN_DIR) / "earshot-journal";

}  // namespace earshot::journal
