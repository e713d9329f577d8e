// earshot tables as a person meets it.
#include <string>
#include <vector>

#include "tests/policy/apps/programs.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::policy_programs {
namespace {

const std::string kPapers = kSource + "/sim/ocean/environments/munk_flat.toml";
const std::string kOceans = kSource + "/policy/worlds/oceans";
const std::string kSeveral = [] {
  std::string files;
  for (const char* name : {"arctic", "deep", "hard_bottom", "hilly", "rock", "shallow", "summer_profile"})
    files += kOceans + "/" + name + ".toml ";
  return files;
}();
const std::string kShallow = kOceans + "/shallow.toml";  // 500 m

/// The paper's environment with one line of it changed.
void write_variant(const fs::path& path, const std::string& line, const std::string& instead) {
  std::string text = content(kPapers);
  const std::size_t at = text.find(line);
  ASSERT_NE(at, std::string::npos);
  std::ofstream(path) << text.replace(at, line.size(), instead);
}

TEST_F(Programs, TablesAreMadeSignedAndShown) {
  ASSERT_EQ(run("tables " + kPapers + " " + kShallow + " -o a.tables --key a.key --new-key --plot a.png"), 0) << content(folder / "err");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.key", "a.png", "a.pub", "a.tables"}));
  EXPECT_TRUE(content(folder / "a.tables").starts_with("EARSHOTT"));
  EXPECT_TRUE(content(folder / "a.png").starts_with("\x89PNG"));
  const std::string made = content(folder / "out");
  ASSERT_EQ(run("tables --show a.tables"), 0) << content(folder / "err");
  const std::string shown = content(folder / "out");
  for (const std::string part : {"20 Hz heard at 300 m from sources at 30 m; sea floors at 500 to 3000 m; 355 ranges, every 100 m",
                                 "0.500               16.1   Munk profile over a flat floor", "500 m of water over mud"}) {
    EXPECT_NE(made.find(part), std::string::npos) << made;
    EXPECT_NE(shown.find(part), std::string::npos) << shown;
  }
  EXPECT_NE(shown.find("\nsigned with the secret half of " + content(folder / "a.pub")), std::string::npos) << shown;
  EXPECT_NE(shown.find("environments = 2\n"), std::string::npos) << shown;
}

TEST_F(Programs, TablesReplaceNoFileThatTheyRead) {
  fs::copy_file(kSource + "/policy/tables/shipped/20hz_300m.tables", folder / "shown.png");
  refuses("tables --show shown.png --plot shown.png --force", {"--show shown.png, --plot shown.png: the same file"});
  fs::create_hard_link(folder / "shown.png", folder / "link.png");
  refuses("tables --show shown.png --plot link.png --force", {"--show shown.png, --plot link.png: the same file"});
  fs::copy_file(kPapers, folder / "ocean.png");
  refuses("tables ocean.png -o a.tables --key a.key --new-key --plot ocean.png --force",
          {"ENVIRONMENT ocean.png, --plot ocean.png: the same"});
  write_ocean_with_section(folder / "own.toml", folder / "section.csv");
  for (const char* named : {"own.toml", "--expected own.toml"})
    refuses("tables " + std::string(named) + " -o section.csv --key a.key --new-key --force",
            {"a file of own.toml: section.csv, --output section.csv: the same file"});
  EXPECT_TRUE(content(folder / "section.csv").starts_with("range_m,depth_m"));
}

TEST_F(Programs, TablesSayWhatIsGivenInAnothersPlace) {
  refuses("tables some.tables", {"ENVIRONMENT some.tables: is a file of tables", "earshot tables --show some.tables"});
  refuses("tables " + kSource + "/policy/worlds/rock.toml -o a.tables --key a.key --new-key",
          {"rock.toml: is a world", "not an environment"});
}

TEST_F(Programs, TablesOfTheSameEnvironmentsAreTheSameBytes) {
  ASSERT_EQ(run("tables " + kSeveral + " -o a.tables --key a.key --new-key --at-most 5"), 0) << content(folder / "err");
  ASSERT_EQ(run("tables " + kSeveral + " -o b.tables --key a.key --at-most 5"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "a.tables"), content(folder / "b.tables"));
}

TEST_F(Programs, TablesSayWhatWasMergedAndHowFarItIsFromItsTable) {
  ASSERT_EQ(run("tables " + kSeveral + " -o a.tables --key a.key --new-key --at-most 5"), 0) << content(folder / "err");
  const std::string made = content(folder / "out");
  EXPECT_TRUE(support::has_line(made, {"78 curves", "5 tables", "none"})) << made;  // six oceans, 9 x 8 of a library
  EXPECT_NE(made.find("a.tables: "), std::string::npos);
  EXPECT_NE(made.find(" bytes, 5 tables\n"), std::string::npos) << made;
}

TEST_F(Programs, TablesHoldAnExpectedOceanUnmergedAndAsLikelyAsAllOthers) {
  ASSERT_EQ(run("tables " + kSeveral + "--expected " + kPapers + " -o a.tables --key a.key --new-key --at-most 5 --origin hand"), 0)
      << content(folder / "err");
  const std::string made = content(folder / "out");
  EXPECT_NE(made.find("79 curves became 5 tables"), std::string::npos) << made;
  EXPECT_TRUE(support::has_line(made, {"3000", "0.500", "16.1", "Munk profile"})) << made;
  ASSERT_EQ(run("tables --show a.tables"), 0);
  for (const std::string part : {"expected = 1\n", "origin = hand\n", "environments = 8\n"})
    EXPECT_NE(content(folder / "out").find(part), std::string::npos) << content(folder / "out");
}

TEST_F(Programs, TablesCountAnExpectedOceanOnceThoughAFolderHoldsIt) {
  fs::create_directory(folder / "oceans");
  fs::copy_file(kPapers, folder / "oceans/paper.toml");
  fs::copy_file(kShallow, folder / "oceans/shallow.toml");
  ASSERT_EQ(run("tables oceans --expected oceans/paper.toml -o a.tables --key a.key --new-key"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find(" bytes, 2 tables\n"), std::string::npos) << content(folder / "out");
  ASSERT_EQ(run("tables --expected oceans/paper.toml -o b.tables --key a.key"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find(" bytes, 1 table\n"), std::string::npos) << content(folder / "out");
}

TEST_F(Programs, TablesTakeOneExpectedFileEachTimeAndSayHowManyOfEachKindThereAre) {
  const std::string rest = " -o a.tables --key a.key ";
  ASSERT_EQ(run("tables -o b.tables --key a.key --new-key --expected " + kPapers + " " + kSeveral), 0) << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "out"),
                                {"read", "1 expected", "--expected", "0 variants", "--variants", "7 others", "ENVIRONMENT"}))
      << content(folder / "out");
  ASSERT_EQ(run("tables --expected " + kPapers + rest + "--variants " + kShallow + " " + kOceans + "/deep.toml --variants " + kOceans +
                "/rock.toml"),
            0)
      << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "out"),
                                {"read", "1 expected", "--expected", "2 variants", "--variants", "1 others", "ENVIRONMENT"}))
      << content(folder / "out");
}

TEST_F(Programs, TablesCountAFileOnceThatIsGivenTwiceAndSaySo) {
  fs::copy_file(kPapers, folder / "paper.toml");
  ASSERT_EQ(run("tables ./paper.toml paper.toml --expected " + kShallow + " --expected " + kShallow + " -o a.tables --key a.key --new-key"),
            0)
      << content(folder / "err");
  const std::string said = content(folder / "out");
  EXPECT_TRUE(support::has_line(said, {"paper.toml", "twice", "once", "the"})) << said;
  EXPECT_TRUE(support::has_line(said, {kShallow, "twice", "counts", "once", "expected"})) << said;
  EXPECT_TRUE(support::has_line(said, {"read", "1 expected", "--expected", "0 variants", "--variants", "1 others", "ENVIRONMENT"})) << said;
  EXPECT_NE(said.find(" bytes, 2 tables\n"), std::string::npos) << said;
}

TEST_F(Programs, TablesHoldVariantsUnmergedEachAsLikelyAsOneOfTheOthersOnTheMean) {
  fs::create_directory(folder / "variants");
  fs::copy_file(kShallow, folder / "variants/shallow.toml");
  fs::copy_file(kPapers, folder / "variants/paper.toml");
  ASSERT_EQ(run("tables " + kSeveral + "--expected variants/paper.toml --variants variants -o a.tables --key a.key --new-key --at-most 6"),
            0)
      << content(folder / "err");
  // One expected, one variant (the other is expected), four of the rest: half of the weight, and a tenth each.
  EXPECT_TRUE(support::has_line(content(folder / "out"), {"3000", "0.500", "16.1"})) << content(folder / "out");
  EXPECT_NE(content(folder / "out").find("        500   0.100"), std::string::npos) << content(folder / "out");
  ASSERT_EQ(run("tables --show a.tables"), 0);
  for (const std::string part : {"expected = 1\n", "variants = 1\n"})
    EXPECT_NE(content(folder / "out").find(part), std::string::npos) << content(folder / "out");
}

TEST_F(Programs, TablesLeaveOutAnOceanTooShallowForTheVehicleAndSaySo) {
  ASSERT_EQ(run("tables " + kPapers + " " + kShallow + " -o a.tables --key a.key --new-key --vehicle-depth-m 600"), 0)
      << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "out"), {kShallow, "500 m", "mud", "above"})) << content(folder / "out");
  EXPECT_NE(content(folder / "out").find(" bytes, 1 table\n"), std::string::npos);
}

TEST_F(Programs, TablesRefuseBadInputInOneLine) {
  ASSERT_EQ(run("tables " + kPapers + " -o good.tables --key a.key --new-key"), 0) << content(folder / "err");
  write_variant(folder / "higher.toml", "frequency_hz = 20.0", "frequency_hz = 40.0");
  fs::create_directory(folder / "empty");
  const std::string rest = " -o a.tables --key a.key ";
  refuses("tables none.toml" + rest, {"none.toml", "no such file"});
  refuses("tables empty" + rest, {"empty", "holds no environment file"});
  refuses("tables " + kPapers + " higher.toml" + rest, {"source.frequency_hz = 40", "higher.toml", "must be one frequency", kPapers});
  refuses("tables " + kShallow + rest + "--vehicle-depth-m 500", {"--vehicle-depth-m", kShallow, "the sea floor lies above the vehicle"});
  refuses("tables " + kPapers + rest + "--vehicle-depth-m 0", {"--vehicle-depth-m"});
  refuses("tables " + kPapers + rest + "--furthest-m 100000", {"--furthest-m", "512 ranges", "--range-step-m 196"});
  refuses("tables " + kPapers + rest + "--range-step-m nan", {"--range-step-m"});
  refuses("tables " + kPapers + rest + "--at-most 97", {"--at-most"});
  refuses("tables " + kPapers + " -o nowhere/a.tables --key a.key", {"nowhere/a.tables", "cannot be written"});
  refuses("tables " + kPapers + " -o a.tables", {"--key"});
  refuses("tables " + kPapers + " --key a.key", {"--output"});
  refuses("tables " + kPapers + " -o a.tables --key none.key", {"none.key", "--new-key"});
  refuses("tables " + kPapers + " -o a.pub --key a.key", {"a.pub", "the same file"});
  refuses("tables " + kPapers + rest + "--plot a.jpg", {"a.jpg", ".png or .svg"});
  refuses("tables " + kOceans + "/hilly.toml" + rest + "--vehicle-depth-m 250", {"hilly.nc", "has no fields at the vehicle's depth"});
  refuses("tables " + kPapers + rest + "--expected higher.toml", {"source.frequency_hz = 20", "must be one frequency", "higher.toml"});
  refuses("tables " + kPapers + rest + "--expected none.toml", {"none.toml", "no such file"});
  refuses("tables " + kPapers + rest + "--vehicle-depth-m 600 --expected " + kShallow, {"--vehicle-depth-m", kShallow, "is expected"});
  refuses("tables " + kShallow + rest + "--at-most 1 --expected " + kPapers,
          {"--expected, --variants: 1 curves", "no room for others in 1 tables"});
  refuses("tables --expected higher.toml -o higher.toml --key a.key --force", {"--expected higher.toml", "the same file"});
  refuses("tables " + kShallow + rest + "--variants " + kPapers, {"--variants", "give --expected"});
  refuses("tables --expected " + kPapers + " --variants higher.toml -o higher.toml --key a.key --force",
          {"--variants higher.toml", "the same file"});
  refuses("tables higher.toml -o higher.toml --key a.key --force", {"ENVIRONMENT higher.toml", "the same file"});
}

TEST_F(Programs, TablesReplaceNoFileOfAnotherKindUnlessForced) {
  std::ofstream(folder / "a.tables") << "mine\n";
  ASSERT_EQ(run("tables " + kPapers + " -o b.tables --key a.key --new-key"), 0);
  refuses("tables " + kPapers + " -o a.tables --key a.key", {"a.tables", "--force"});
  EXPECT_EQ(content(folder / "a.tables"), "mine\n");
  EXPECT_EQ(run("tables " + kPapers + " -o b.tables --key a.key"), 0) << content(folder / "err");
  EXPECT_EQ(run("tables " + kPapers + " -o a.tables --key a.key --force"), 0) << content(folder / "err");
}

TEST_F(Programs, TablesShowsNoDamagedOrOtherFileAndSaysWhoseSignatureDoesNotHold) {
  ASSERT_EQ(run("tables " + kPapers + " -o a.tables --key a.key --new-key"), 0);
  std::string bytes = content(folder / "a.tables");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder / "damaged.tables", std::ios::binary) << bytes;
  std::ofstream(folder / "cut.tables", std::ios::binary) << content(folder / "a.tables").substr(0, 300);
  std::string unsigned_bytes = content(folder / "a.tables");
  unsigned_bytes.back() = static_cast<char>(unsigned_bytes.back() ^ 1);
  std::ofstream(folder / "unsigned.tables", std::ios::binary) << unsigned_bytes;
  refuses("tables --show damaged.tables", {"damaged.tables: is damaged: its CRC-32 is wrong"});
  refuses("tables --show cut.tables", {"cut.tables: is cut short"});
  refuses("tables --show " + kFixedSource, {"is not a .tables file"});
  refuses("tables --show a.tables " + kPapers, {"--show"});
  refuses("tables --show a.tables --key a.key", {"--show"});
  refuses("tables --show a.tables --expected " + kPapers, {"--show"});
  refuses("tables --show a.tables --variants " + kPapers, {"--show"});
  ASSERT_EQ(run("tables --show unsigned.tables"), 0);
  EXPECT_NE(content(folder / "out").find("NOT signed with the secret half of " + content(folder / "a.pub")), std::string::npos);
}

}  // namespace
}  // namespace earshot::policy_programs
