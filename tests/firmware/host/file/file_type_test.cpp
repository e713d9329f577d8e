#include "firmware/host/file/file_type.hpp"

#include <gtest/gtest.h>

namespace earshot::host {
namespace {

TEST(FileType, HasTheEndOfItsNameInSmallLetters) {
  EXPECT_EQ(suffix_of("folder.d/a.b.SHD"), ".shd");
  EXPECT_EQ(suffix_of(".grid"), ".grid");
  EXPECT_EQ(suffix_of("folder.d/a"), "");
  EXPECT_EQ(suffix_of("a."), ".");
  EXPECT_EQ(suffix_of(""), "");
}

}  // namespace
}  // namespace earshot::host
