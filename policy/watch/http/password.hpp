#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace earshot::watch {

/// What a browser must know. Its checksum alone is kept.
/// Oracle: Password.*
class Password {
 public:
  static constexpr std::size_t kLeastCharacters = 12;

  /// The first line of a file that nobody else may read.
  /// @throws host::BadInput when others may, or it is too short
  [[nodiscard]] static Password of_file(const std::filesystem::path& path);

  explicit Password(std::string_view text);

  /// Whether an Authorization header bears it, with any user name. How long it takes does not depend on how much of it is right.
  /// Source: RFC 7617.
  [[nodiscard]] bool is_in(std::string_view authorization) const;

 private:
  std::array<std::uint8_t, 32> checksum_{};
};

}  // namespace earshot::watch
