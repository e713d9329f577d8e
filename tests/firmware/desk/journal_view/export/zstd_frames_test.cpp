#include "firmware/desk/journal_view/export/zstd_frames.hpp"

#include <gtest/gtest.h>
#include <zstd.h>

#include <string>

namespace earshot::journal {
namespace {

/// Oracle: libzstd's decoder, which is told nothing but the frame.
std::string unpacked(std::string_view frame) {
  std::string piece(ZSTD_getFrameContentSize(frame.data(), frame.size()), '\0');
  const std::size_t size = ZSTD_decompress(piece.data(), piece.size(), frame.data(), frame.size());
  return ZSTD_isError(size) != 0U ? ZSTD_getErrorName(size) : piece.substr(0, size);
}

TEST(ZstdFrames, StandAloneAndStateTheirSize) {
  ZstdFrames frames;
  const std::string same(100'000, 'a');
  const std::string first(frames.compress(same));
  EXPECT_EQ(first.substr(0, 4), "\x28\xB5\x2F\xFD");  // RFC 8878, 3.1.1: the magic number, little-endian
  EXPECT_LT(first.size(), 100U);
  const std::string second(frames.compress("of another kind"));
  EXPECT_EQ(unpacked(first), same);
  EXPECT_EQ(unpacked(second), "of another kind");
  EXPECT_EQ(unpacked(frames.compress("")), "");
}

}  // namespace
}  // namespace earshot::journal
