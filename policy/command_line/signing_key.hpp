#pragma once

#include <string>

#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/program/command_line.hpp"
#include "firmware/host/trust/keys.hpp"

namespace earshot::command_line {

/// The part of a command line that says which key signs what is written.
struct SigningKeyOptions {
  std::string key;
  bool new_key = false;
  bool public_key = false;

  /// Declares --key, --new-key and --public-key.
  program::Option add_to(program::CommandLine& line);
  [[nodiscard]] bool only_makes_keys() const { return new_key || public_key; }
  /// What is signed must not be written over the key that signs it, nor over its public half. Throws host::BadInput.
  void add_to(host::DistinctFiles& read) const;
  /// The key, made first where --new-key says so; says which files it wrote, and which a vehicle needs and are missing.
  /// @param force  a lone public half may be replaced
  /// Throws host::BadInput naming the file.
  [[nodiscard]] host::SecretKey read(bool force) const;
};

}  // namespace earshot::command_line
