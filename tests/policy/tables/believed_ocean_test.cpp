#include "policy/tables/believed_ocean.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::tables {
namespace {

namespace fs = std::filesystem;

const std::string kOceans = EARSHOT_SOURCE_DIR "/policy/worlds/oceans";
const std::string kPapers = EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml";

template <class Work>
std::string complaint_of(Work work) {
  try {
    work();
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "";
}

TEST(EnvironmentFiles, AreThoseNamedAndTheTomlFilesOfFoldersByName) {
  const support::TemporaryFolder folder;
  for (const char* name : {"b.toml", "a.toml", "c.nc"}) std::ofstream(folder / name) << "";
  EXPECT_EQ(environment_files({"z.toml", (folder / "").string(), "y.toml"}),
            (std::vector<fs::path>{"z.toml", folder / "a.toml", folder / "b.toml", "y.toml"}));
}

TEST(EnvironmentFiles, RefuseAFolderWithoutAny) {
  const support::TemporaryFolder folder;
  const std::string name = (folder / "").string();
  EXPECT_EQ(complaint_of([&] { (void)environment_files({name}); }), name + ": holds no environment file (.toml)");
}

TEST(OceansIn, AreTheFilesOwnAndEveryMemberOfItsFamilyByNumber) {
  const std::vector<BelievedOcean> oceans = oceans_in(EARSHOT_SOURCE_DIR "/policy/ppo/runs/shipped_ocean.toml");
  ASSERT_EQ(oceans.size(), 16U);  // its own, and family.members = 15
  EXPECT_EQ(oceans[0].detail, "");
  EXPECT_EQ(oceans[1].detail, " 1");
  EXPECT_EQ(oceans[15].detail, " 15");
  EXPECT_EQ(oceans[15].environment.name, oceans[0].environment.name);
  EXPECT_NE(oceans[15].environment.seabed.depth, oceans[0].environment.seabed.depth);
}

TEST(OceansIn, AreThoseThatTheFileNamesBesideItsOwn) {
  const support::TemporaryFolder folder;
  fs::copy_file(kPapers, folder / "two.toml");
  fs::permissions(folder / "two.toml", fs::perms::owner_write, fs::perm_options::add);
  std::ofstream(folder / "two.toml", std::ios::app) << "\n[[oceans]]\nenvironment = \"" << kOceans << "/shallow.toml\"\n";
  const std::vector<BelievedOcean> oceans = oceans_in(folder / "two.toml");
  ASSERT_EQ(oceans.size(), 2U);
  EXPECT_EQ(oceans[1].environment.name, "500 m of water over mud");
  EXPECT_EQ(oceans[1].detail, "");
}

TEST(OceansIn, AreOneWithItsFieldLibrary) {
  const std::vector<BelievedOcean> oceans = oceans_in(kOceans + "/hilly.toml");
  ASSERT_EQ(oceans.size(), 1U);
  EXPECT_EQ(oceans[0].field_library.filename(), "hilly.nc");
}

TEST(OneFrequency, IsRequiredOfAllAndBothFilesAreNamed) {
  std::vector<BelievedOcean> oceans = oceans_in(kPapers);
  oceans.push_back(oceans.front());
  EXPECT_NO_THROW(require_one_frequency(oceans));
  oceans[1].file = "other.toml";
  oceans[1].environment.source.frequency = Hertz{40.0};
  EXPECT_TRUE(support::tells(complaint_of([&] { require_one_frequency(oceans); }),
                             {"source.frequency_hz", "40", "other.toml", "source.frequency_hz", "20", kPapers}));
}

}  // namespace
}  // namespace earshot::tables
