#include "firmware/host/safety_record/in_memory.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>

#include <filesystem>
#include <memory>
#include <string>

#include "tests/support/small_disk.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

TEST(InMemory, IsAFolderOfATmpfsAndOneThatIsNotThereYet) {
  const std::unique_ptr<support::SmallDisk> disk = support::SmallDisk::make(256 * 1024);
  if (!disk) GTEST_SKIP() << "this kernel lets only root mount a file system";
  EXPECT_TRUE(is_in_memory(disk->path()));
  EXPECT_TRUE(is_in_memory(disk->path() / "out" / "of" / "a search"));
  EXPECT_FALSE(is_in_memory(EARSHOT_SOURCE_DIR)) << "sources that are in memory are not what this test is for";
}

TEST(InMemory, IsAnOverlayWhoseUpperLayerIsAndNoneThatIsOnADisk) {
  const std::unique_ptr<support::SmallDisk> disk = support::SmallDisk::make(1024 * 1024);
  if (!disk) GTEST_SKIP() << "this kernel lets only root mount a file system";
  const fs::path upper = disk->path() / "up, and a blank";
  const fs::path root = disk->path() / "root";
  for (const fs::path& folder : {disk->path() / "lower", upper, disk->path() / "work", root}) fs::create_directory(folder);
  std::string escaped = upper.string();
  escaped.insert(escaped.find(','), "\\");
  const std::string options =
      "lowerdir=" + (disk->path() / "lower").string() + ",upperdir=" + escaped + ",workdir=" + (disk->path() / "work").string();
  if (::mount("overlay", root.c_str(), "overlay", 0, options.c_str()) != 0) GTEST_SKIP() << "no overlay can be mounted here";
  EXPECT_TRUE(is_in_memory(root));
  EXPECT_TRUE(is_in_memory(root / "var" / "lib"));
  EXPECT_EQ(::umount2(root.c_str(), MNT_DETACH), 0);
}

// As Linux 6.1 writes it, of a root that `overlayroot` keeps unchanged and of a container.
TEST(InMemory, FindsTheUpperLayerAmongMounts) {
  const std::string mounts =
      "22 1 0:21 / / rw,relatime shared:1 - overlay overlayroot "
      "rw,lowerdir=/media/root-ro,upperdir=/media/root-rw/over\\040lay,workdir=/media/root-rw/overlay-workdir\n"
      "23 22 0:22 / /media/root-rw rw,relatime shared:2 master:3 - tmpfs tmpfs-root rw\n"
      "24 22 0:23 / /ro ro,relatime - overlay none ro,lowerdir=/a:/b\n"
      "25 22 0:24 / /odd rw - overlay none rw,lowerdir=/a,workdir=/upperdir=/w,upperdir=/with\\134,comma\n";
  EXPECT_EQ(upper_layer(mounts, "0:21"), "/media/root-rw/over lay");
  EXPECT_EQ(upper_layer(mounts, "0:22"), std::nullopt) << "no overlay";
  EXPECT_EQ(upper_layer(mounts, "0:23"), std::nullopt) << "nothing is written there";
  EXPECT_EQ(upper_layer(mounts, "0:24"), "/with,comma");
  EXPECT_EQ(upper_layer(mounts, "0:2"), std::nullopt);
}

}  // namespace
}  // namespace earshot::host
