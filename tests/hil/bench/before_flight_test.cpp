#include "hil/bench/before_flight.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

const std::filesystem::path kMission = std::filesystem::path(EARSHOT_SOURCE_DIR) / "hil/missions/search_over_lcm.toml";

Case named(const std::string& name) {
  Case c;
  c.name = name;
  c.mission = kMission;
  c.bus = host::PortKind::kLcm;
  return c;
}

template <class Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "";
}

std::string refusal_of(const std::vector<Case>& cases) {
  return refusal([&] { require_flyable(cases); });
}

TEST(BeforeFlight, TakesCasesOfAnyNameThatCanBeAFolders) {
  EXPECT_EQ(refusal_of({named("calm"), named("it's <b>bold</b>, \"quoted\""), named("-x"), named("K\xC3\xA4se")}), "");
}

TEST(BeforeFlight, RefusesToFlyNothing) {
  EXPECT_NE(refusal_of({}).find("there is no case"), std::string::npos);
}

TEST(BeforeFlight, RefusesNamesThatLeaveACaseNoFolderOfItsOwn) {
  for (const std::string name : {".", "..", ".hidden", "results.json", "two\nlines", "\xFF"})
    EXPECT_NE(refusal_of({named("calm"), named(name)}).find("can have no folder of its own"), std::string::npos) << name;
  EXPECT_EQ(refusal_of({named("calm"), named("leak"), named("calm")}), "calm: two cases have this name");
}

TEST(BeforeFlight, RefusesACaseWhoseMissionIsNotThere) {
  Case lost = named("lost");
  lost.mission = "/no/such/mission.toml";
  EXPECT_EQ(refusal_of({named("calm"), lost}), "/no/such/mission.toml: no such file");
}

TEST(BeforeFlight, MakesAFolderForOneRunAtATime) {
  const support::TemporaryFolder folder;
  const std::filesystem::path out = folder / "a/b";
  {
    const host::FileDescriptor lock = take_folder(out);
    EXPECT_THROW((void)take_folder(out), host::FolderInUse);
  }
  EXPECT_EQ(refusal([&] { (void)take_folder(out); }), "");
}

TEST(BeforeFlight, RefusesToReplaceResultsThatAreNone) {
  const support::TemporaryFolder folder;
  std::ofstream(results_file(folder.path())) << "{\"mine\": 1}";
  EXPECT_NE(refusal([&] { (void)take_folder(folder.path()); }).find("is not what earshot-bench writes"), std::string::npos);
  std::ofstream(results_file(folder.path())) << "{\n \"cases\": []\n}\n";
  EXPECT_EQ(refusal([&] { (void)take_folder(folder.path()); }), "");
  std::filesystem::remove(results_file(folder.path()));
  std::filesystem::create_directory(results_file(folder.path()));
  EXPECT_NE(refusal([&] { (void)take_folder(folder.path()); }).find("only regular files are replaced"), std::string::npos);
}

TEST(BeforeFlight, NeedsNoBusForCasesOverLcm) {
  EXPECT_FALSE(take_bus({named("calm")}, "can77").has_value());
}

TEST(BeforeFlight, RefusesAnInterfaceThatIsNotThere) {
  Case over_can = named("calm");
  over_can.bus = host::PortKind::kCan;
  EXPECT_THROW((void)take_bus({named("first"), over_can}, "can77"), std::system_error);
}

}  // namespace
}  // namespace earshot::hil
