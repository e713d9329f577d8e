#include "firmware/host/file/distinct_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

TEST(DistinctFiles, RefusesToWriteWhatIsReadByWhateverName) {
  const support::TemporaryFolder folder;
  fs::create_symlink("journal", folder / "link");
  DistinctFiles files;
  files.read(folder / "journal");
  for (const char* name : {"journal", "link", "./journal", "there/../journal"}) EXPECT_THROW(files.write(folder / name), BadInput) << name;
  EXPECT_NO_THROW(files.write(folder / "other"));
}

TEST(DistinctFiles, RefusesToWriteOneFileTwice) {
  const support::TemporaryFolder folder;
  DistinctFiles files;
  files.write(folder / "map");
  try {
    files.write(folder / "./map");
    ADD_FAILURE();
  } catch (const BadInput& error) {
    EXPECT_EQ(std::string(error.what()), (folder / "./map").string() + ": cannot be written: the same file is read, or written already");
  }
}

}  // namespace
}  // namespace earshot::host
