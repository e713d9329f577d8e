#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/process.hpp"

namespace earshot::report {

inline constexpr const char* kTypeScript = "/usr/bin/tsc";  ///< Debian: node-typescript

/// What TypeScript's compiler complains of when a JSON text is said to be of a type of the page; "": nothing.
/// @param folder  for its files
inline std::string type_complaints(const std::string& type, const std::string& json, const std::filesystem::path& folder) {
  const std::filesystem::path types = std::filesystem::path(EARSHOT_SOURCE_DIR) / "policy/report/page/source/flight.ts";
  std::filesystem::copy_file(types, folder / "flight.ts", std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder / "made.ts") << "import { " << type << " } from \"./flight\";\nexport const made: " << type << " = " << json
                                    << ";\n";
  support::Process compiler(kTypeScript, {"--strict", "--noEmit", "--target", "es2020", folder / "made.ts"}, folder / "complaints");
  const int status = compiler.wait(std::chrono::seconds(60));
  return status == 0 ? "" : "status " + std::to_string(status) + ": " + compiler.output();
}

}  // namespace earshot::report
