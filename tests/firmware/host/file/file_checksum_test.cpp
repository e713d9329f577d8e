#include "firmware/host/file/file_checksum.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

TEST(FileChecksum, OfOneFileAndOfSeveralInARowIsThatOfTheirBytes) {
  const support::TemporaryFolder folder;
  std::ofstream(folder.path() / "whole") << "123456789";
  std::ofstream(folder.path() / "first") << "12345";
  std::ofstream(folder.path() / "second") << "6789";
  // The check value of CRC-32 (ISO 3309, IEEE 802.3).
  EXPECT_EQ(crc32_of_file(folder.path() / "whole"), 0xCBF43926U);
  EXPECT_EQ(crc32_of_file(folder.path() / "second", crc32_of_file(folder.path() / "first")), 0xCBF43926U);
  EXPECT_THROW((void)crc32_of_file(folder.path() / "none"), BadInput);
}

TEST(FileChecksum, GoesOnWhereAPieceEnds) {
  const support::TemporaryFolder folder;
  // A mebibyte is read at once. CRC-32 of 2^20 and of 2^20 + 1 zeros: zlib's crc32.
  std::ofstream(folder.path() / "piece") << std::string(std::size_t{1} << 20U, '\0');
  std::ofstream(folder.path() / "more") << std::string((std::size_t{1} << 20U) + 1, '\0');
  EXPECT_EQ(crc32_of_file(folder.path() / "piece"), 0xA738EA1CU);
  EXPECT_EQ(crc32_of_file(folder.path() / "more"), 0xC6A48B28U);
}

}  // namespace
}  // namespace earshot::host
