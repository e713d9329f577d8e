#include "hil/bench/at_sea/sea_computer.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/hil/seconds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

/// No bus is needed for what is tried here.
class SeaComputerTest : public testing::Test {
 protected:
  [[nodiscard]] SeaComputer computer() const { return {case_, "no_interface", folder_.path()}; }
  Case case_;
  const support::TemporaryFolder folder_;
};

TEST_F(SeaComputerTest, StartsEarshotdWithTheMostThatAFullDiskHolds) {
  program::ChildSettings settings;
  computer().set_up(settings);
  EXPECT_NE(settings.most_bytes_of_a_file, 50'000U);
  case_.faults = {{.fault = Fault::kFullDisk, .from = at_s(5), .amount = 50'000.0}};
  computer().set_up(settings);
  EXPECT_EQ(settings.most_bytes_of_a_file, 50'000U);
}

TEST_F(SeaComputerTest, LacksOneFileAsLongAsItsFaultActs) {
  case_.faults = {{.fault = Fault::kFileGone, .from = at_s(5), .until = at_s(8), .device = std::string(kPolicyFile)}};
  EXPECT_FALSE(computer().is_gone(kPolicyFile, at_s(4)));
  EXPECT_TRUE(computer().is_gone(kPolicyFile, at_s(5)));
  EXPECT_FALSE(computer().is_gone(kTablesFile, at_s(5)));
  EXPECT_FALSE(computer().is_gone(kPolicyFile, at_s(8)));
}

TEST_F(SeaComputerTest, HasADiskThatIsSickUntilTheFaultIsOver) {
  const TimedFault slow{.fault = Fault::kSlowDisk, .from = at_s(5)};
  SeaComputer sick = computer();
  sick.begin(slow);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "disk_is_sick"));
  sick.end(slow);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "disk_is_sick"));
}

TEST_F(SeaComputerTest, NamesAFaultThatIsNoneOfItsOwn) {
  EXPECT_THROW(computer().begin({.fault = Fault::kPowerCut, .from = at_s(5)}), NoMaker);
  EXPECT_THROW(computer().end({.fault = Fault::kLeak, .from = at_s(5)}), NoMaker);
}

}  // namespace
}  // namespace earshot::hil
