#include "firmware/host/toml/table_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

/// A folder of this program, for the files of its tests.
const std::filesystem::path& folder() {
  static const support::TemporaryFolder folder;
  return folder;
}

std::filesystem::path written(const std::string& toml) {
  const std::filesystem::path path = folder() / "written.toml";
  std::ofstream(path) << toml;
  return path;
}

/// What finish() complains about after `read`, every line without the file's name; empty if nothing.
template <class Read>
std::string complaint(const std::string& toml, Read read) {
  const TomlFile file(written(toml));
  TableReader root = file.root();
  read(root);
  try {
    file.finish();
  } catch (const BadInput& bad) {
    std::string text = bad.what();
    for (std::size_t at = text.find(file.path().string()); at != std::string::npos; at = text.find(file.path().string())) {
      text.erase(at, file.path().string().size());
    }
    return text;
  }
  return {};
}

TEST(TableReader, GivesTheValuesAsWritten) {
  const TomlFile file(written("depth_m = 300.5\nsteps = 100\ndry = true\nname = 'fin'\nkind = 'two'\nat_m = [1, 2.5]\nwhole_m = 3\n"));
  TableReader root = file.root();
  EXPECT_EQ(root.number("depth_m"), 300.5);
  EXPECT_EQ(root.number("whole_m"), 3.0);
  EXPECT_EQ(root.integer("steps", 1, 1000), 100);
  EXPECT_TRUE(root.boolean_or("dry", false));
  EXPECT_EQ(root.text("name"), "fin");
  EXPECT_EQ(root.choice("kind", {"one", "two"}), 1U);
  EXPECT_EQ(root.numbers("at_m"), (std::vector{1.0, 2.5}));
  EXPECT_NO_THROW(file.finish());
}

TEST(TableReader, FallsBackOnlyWhereTheKeyIsMissing) {
  const TomlFile file(written("present_m = 1.0\n"));
  TableReader root = file.root();
  EXPECT_EQ(root.number_or("present_m", 7.0), 1.0);
  EXPECT_EQ(root.number_or("absent_m", 7.0), 7.0);
  EXPECT_EQ(root.integer_or("absent", 7, 0, 9), 7);
  EXPECT_EQ(root.text_or("absent_text", "seven"), "seven");
  EXPECT_EQ(root.choice_or("absent_choice", 1, {"a", "b"}), 1U);
  EXPECT_NO_THROW(file.finish());
}

TEST(TableReader, NamesLineKeyValueAndAllowedRange) {
  const auto read = [](TableReader& root) { static_cast<void>(root.number("frequency_hz", Range::above(0))); };
  EXPECT_TRUE(support::tells(complaint("\nfrequency_hz = -20\n", read), {"2", "frequency_hz", "-20", "above 0"}));
}

TEST(TableReader, SaysOfEveryKindOfKeyThatIsMissingWhatBelongsThere) {
  const std::string said = complaint("", [](TableReader& root) {
    EXPECT_EQ(root.integer("steps", 2, 1000), 2);
    EXPECT_EQ(root.text("name"), "");
    EXPECT_EQ(root.choice("kind", {"one", "two"}), 0U);
    EXPECT_EQ(root.choices("roles", {"one", "two"}), (std::vector<std::size_t>{0}));
    EXPECT_TRUE(root.numbers("at_m").empty());
    EXPECT_TRUE(root.tables("port").empty());
  });
  EXPECT_TRUE(support::lines_tell(said, {{"1", "steps", "missing", "2 to 1000"},
                                         {"1", "name", "missing", "at least"},
                                         {"1", "kind", "missing", "one", "two"},
                                         {"1", "roles", "missing", "one", "two", "once"},
                                         {"1", "at_m", "missing"},
                                         {"1", "port", "missing"}}));
}

TEST(TableReader, FallsBackOnEveryKindOfValue) {
  const TomlFile file(written("steps = 5\nkind = 'two'\nname = 'fin'\n"));
  TableReader root = file.root();
  EXPECT_EQ(root.integer_or("steps", 7, 1, 10), 5);
  EXPECT_EQ(root.integer_or("others", 7, 1, 10), 7);
  EXPECT_EQ(root.choice_or("kind", 0, {"one", "two"}), 1U);
  EXPECT_EQ(root.choice_or("other", 1, {"one", "two"}), 1U);
  EXPECT_EQ(root.text_or("name", "blue"), "fin");
  EXPECT_EQ(root.text_or("other", "blue"), "blue");
  EXPECT_FALSE(root.boolean_or("is_dry", false));
  EXPECT_NO_THROW(file.finish());
}

TEST(TableReader, TakesSeveralWordsEachOnce) {
  const auto roles_of = [](const std::string& toml, std::vector<std::size_t>& roles) {
    return complaint(toml, [&](TableReader& root) { roles = root.choices("roles", {"sees", "hears", "steers"}); });
  };
  std::vector<std::size_t> roles;
  EXPECT_EQ(roles_of("roles = ['steers', 'sees']\n", roles), "");
  EXPECT_EQ(roles, (std::vector<std::size_t>{2, 0}));
  const std::string wanted = R"(: must be one of "sees", "hears", "steers", or several of them in an array, each once)";
  EXPECT_EQ(roles_of("roles = 3\n", roles), ":1: roles = 3" + wanted);
  EXPECT_EQ(roles, (std::vector<std::size_t>{0}));
  EXPECT_EQ(roles_of("roles = []\n", roles), ":1: roles" + wanted);
  EXPECT_EQ(roles_of("roles = ['sees', 'sees']\n", roles), ":1: roles" + wanted);
  EXPECT_EQ(roles_of("roles = ['sees', 'swims']\n", roles), ":1: roles" + wanted);
  EXPECT_EQ(roles_of("roles = ['sees', 1]\n", roles), ":1: roles" + wanted);
}

TEST(TableReader, RefusesWhatIsNoTruthValueNoArrayAndNoTable) {
  const std::string said = complaint("dry = 1\nat_m = 2.0\nport = 3\nsea = 4\n", [](TableReader& root) {
    EXPECT_TRUE(root.boolean_or("dry", true));
    EXPECT_TRUE(root.numbers("at_m").empty());
    EXPECT_TRUE(root.tables("port").empty());
    (void)root.table("sea");
  });
  EXPECT_TRUE(support::lines_tell(said, {{"1", "dry", "1", "true", "false"}, {"2", "at_m", "2.0"}, {"3", "port", "3"}, {"4", "sea", "4"}}));
}

TEST(TableReader, RefusesNanAndInfinityWithoutAskingForARange) {
  const auto read = [](TableReader& root) { static_cast<void>(root.number("x_m")); };
  EXPECT_EQ(complaint("x_m = nan\n", read), ":1: x_m = nan: must be a finite number");
  EXPECT_EQ(complaint("x_m = -inf\n", read), ":1: x_m = -inf: must be a finite number");
}

TEST(TableReader, SaysANumberAsShortAsItWasWritten) {
  const auto read = [](TableReader& root) { static_cast<void>(root.number("x", Range::between(1, 2))); };
  const std::string within = ": must be a finite number of at least 1 and at most 2";
  EXPECT_EQ(complaint("x = 0.4\n", read), ":1: x = 0.4" + within);
  EXPECT_EQ(complaint("x = 100000.0\n", read), ":1: x = 100000.0" + within);
  EXPECT_EQ(complaint("x = 9999999999.5\n", read), ":1: x = 9999999999.5" + within);
  EXPECT_EQ(complaint("x = 0.0\n", read), ":1: x = 0.0" + within);
  EXPECT_EQ(complaint("x = 1e-7\n", read), ":1: x = 1e-07" + within);
  EXPECT_EQ(complaint("x = -2e30\n", read), ":1: x = -2e+30" + within);
}

TEST(TableReader, KeepsTheBoundsOfARange) {
  const auto within = [](TableReader& root) { static_cast<void>(root.number("x", Range::between(1, 2))); };
  EXPECT_EQ(complaint("x = 1", within), "");
  EXPECT_EQ(complaint("x = 2", within), "");
  EXPECT_NE(complaint("x = 0.999", within), "");
  EXPECT_NE(complaint("x = 2.001", within), "");
  const auto above = [](TableReader& root) { static_cast<void>(root.number("x", Range::above_up_to(1, 2))); };
  EXPECT_NE(complaint("x = 1", above), "");
  EXPECT_EQ(complaint("x = 2", above), "");
}

TEST(TableReader, RefusesAFractionOrATextWhereAWholeNumberBelongs) {
  const auto read = [](TableReader& root) { static_cast<void>(root.integer("n", 1, 9)); };
  EXPECT_TRUE(support::tells(complaint("n = 2.5", read), {"1", "n", "2.5", "1 to 9"}));
  EXPECT_TRUE(support::tells(complaint("n = 'two'", read), {"1", "n", "two", "1 to 9"}));
  EXPECT_TRUE(support::tells(complaint("n = 10", read), {"1", "n", "10", "1 to 9"}));
}

TEST(TableReader, RefusesAnEmptyTextAndANumberWhereATextBelongs) {
  const auto read = [](TableReader& root) { static_cast<void>(root.text("file")); };
  EXPECT_TRUE(support::tells(complaint("\nfile = ''", read), {"2", "file", "at least"}));
  EXPECT_TRUE(support::tells(complaint("file = 3", read), {"1", "file", "3", "at least"}));
}

TEST(TableReader, ListsTheWordsThatAreAllowed) {
  const auto read = [](TableReader& root) { static_cast<void>(root.choice("bus", {"lcm", "can"})); };
  EXPECT_TRUE(support::tells(complaint("bus = 'usb'", read), {"1", "bus", "usb", "lcm", "can"}));
}

TEST(TableReader, RefusesAKeyNobodyAskedFor) {
  const auto read = [](TableReader& root) { static_cast<void>(root.number("depth_m")); };
  EXPECT_EQ(complaint("depth_m = 1\ndepht_m = 2\n", read), ":2: depht_m: unknown key");
}

TEST(TableReader, DoesNotCountLookingForAKeyAsAskingForIt) {
  const auto read = [](TableReader& root) { EXPECT_TRUE(root.has("depth_m")); };
  EXPECT_EQ(complaint("depth_m = 1\n", read), ":1: depth_m: unknown key");
}

TEST(TableReader, NamesTheElementOfAnArray) {
  const auto read = [](TableReader& root) { static_cast<void>(root.numbers("speed_mps", Range::above(0))); };
  EXPECT_TRUE(support::tells(complaint("speed_mps = [1500,\n nan]", read), {"2", "speed_mps[1]", "nan", "above 0"}));
}

TEST(TableReader, ReadsTablesInTablesAndNamesTheirPath) {
  const auto read = [](TableReader& root) {
    TableReader ocean = root.table("ocean");
    TableReader bed = ocean.table("seabed");
    static_cast<void>(bed.number("density_kg_per_m3"));
  };
  EXPECT_EQ(complaint("[ocean.seabed]\ndensity_kg_per_m3 = 1500", read), "");
  EXPECT_TRUE(support::tells(complaint("[ocean.seabed]\ndensity_kg_per_m3 = 'mud'", read), {"2", "ocean.seabed.density_kg_per_m3", "mud"}));
  EXPECT_EQ(complaint("[ocean]\nseabed = 3", read), ":2: ocean.seabed = 3: must be a table");
}

TEST(TableReader, NotesAMissingTableOnceAndReadsItAsEmpty) {
  const auto read = [](TableReader& root) {
    TableReader ocean = root.table("ocean");
    static_cast<void>(ocean.number("depth_m"));
    static_cast<void>(ocean.number("noise_db"));
  };
  const std::string text = complaint("", read);
  EXPECT_NE(text.find("ocean is missing: must be a table"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(TableReader, GivesNoOptionalTableWhereThereIsNone) {
  const auto read = [](TableReader& root) { EXPECT_FALSE(root.optional_table("can").has_value()); };
  EXPECT_EQ(complaint("", read), "");
}

TEST(TableReader, ReadsEachTableOfAnArray) {
  const auto read = [](TableReader& root) {
    for (TableReader& layer : root.tables("layer")) static_cast<void>(layer.number("thickness_m", Range::above(0)));
  };
  EXPECT_TRUE(support::tells(complaint("[[layer]]\nthickness_m = 1\n[[layer]]\nthickness_m = 0\n", read),
                             {"4", "layer 2", "thickness_m", "0", "above 0"}));
}

TEST(TableReader, GivesNoMoreTablesOfAnArrayThanThereIsRoomFor) {
  std::size_t given = 0;
  const auto read = [&given](TableReader& root) {
    const std::vector<TableReader> layers = root.tables("layer", 2);
    given = layers.size();
  };
  EXPECT_EQ(complaint("[[layer]]\n[[layer]]\n", read), "");
  EXPECT_EQ(given, 2U);
  EXPECT_TRUE(
      support::tells(complaint("\n[[layer]]\n[[layer]]\n[[layer]]\nof_no_interest = 1\n", read), {"2", "layer", "3 tables", "at most 2"}));
  EXPECT_EQ(given, 2U);
}

TEST(TableReader, ReportsTheCallersOwnFindings) {
  const auto read = [](TableReader& root) {
    static_cast<void>(root.number("search_depth_m"));
    root.problem("search_depth_m", "must be less than max_depth_m");
  };
  EXPECT_TRUE(support::tells(complaint("search_depth_m = 400", read), {"1", "search_depth_m", "400", "less than max_depth_m"}));
}

TEST(TableReader, KnowsOfWhichKeysItHasNotedAProblem) {
  const auto read = [](TableReader& root) {
    static_cast<void>(root.number("good_m"));
    static_cast<void>(root.number("bad_m"));
    static_cast<void>(root.number("missing_m"));
    static_cast<void>(root.numbers("bad_in_the_middle_m"));
    EXPECT_FALSE(root.is_noted("good_m"));
    EXPECT_TRUE(root.is_noted("bad_m"));
    EXPECT_TRUE(root.is_noted("missing_m"));
    EXPECT_TRUE(root.is_noted("bad_in_the_middle_m"));
  };
  EXPECT_NE(complaint("good_m = 1\nbad_m = nan\nbad_in_the_middle_m = [1, inf, 2]\n", read), "");
}

TEST(TableReader, ReportsEveryProblemAtOnce) {
  const auto read = [](TableReader& root) {
    static_cast<void>(root.number("a", Range::above(0)));
    static_cast<void>(root.number("b"));
  };
  const std::string text = complaint("a = -1\nc = 3\n", read);
  EXPECT_NE(text.find("a = -1"), std::string::npos);
  EXPECT_NE(text.find("b is missing"), std::string::npos);
  EXPECT_NE(text.find("c: unknown key"), std::string::npos);
}

TEST(TableReader, GivesAHarmlessNumberForABadOne) {
  const TomlFile file(written("a = -1\nb = nan\nc = 5\n"));
  TableReader root = file.root();
  EXPECT_GT(root.number("a", Range::above(0)), 0.0);
  EXPECT_EQ(root.number("b"), 0.0);
  EXPECT_LE(root.number("c", Range::between(1, 2)), 2.0);
}

std::string refusal(const std::filesystem::path& path) {
  try {
    const TomlFile file(path);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return {};
}

TEST(TomlFile, SaysThatThereIsNone) {
  EXPECT_EQ(refusal("/nowhere/mission.toml"), "/nowhere/mission.toml: no such file");
}

TEST(TomlFile, RefusesAFolder) {
  EXPECT_NE(refusal(folder()).find("cannot be read"), std::string::npos);
}

TEST(TomlFile, NamesTheLineThatIsNotToml) {
  const std::filesystem::path path = written("a = 1\nb = = 2\n");
  EXPECT_EQ(refusal(path).rfind(path.string() + ":2: not TOML: ", 0), 0U) << refusal(path);
}

TEST(TomlFile, SaysInOneLineWhatIsNotTomlWhereALineBreaksInAValue) {
  const std::filesystem::path path = written("a = n\n");
  const std::string said = refusal(path);
  EXPECT_EQ(said.rfind(path.string() + ":1: not TOML: ", 0), 0U) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

TEST(TomlFile, RefusesAKeyOfFortyThousandDotsBeforeItIsParsed) {
  std::string key = "a";
  for (int i = 0; i < 40'000; ++i) key += ".a";
  EXPECT_TRUE(support::has_line(refusal(written(key + "=1\n")), {"1", "32 deep"}));
}

TEST(TomlFile, RefusesTomlOfMoreThanFourMebibytes) {
  const std::filesystem::path path = written("");
  std::filesystem::resize_file(path, (std::uintmax_t{4} << 20U) + 1);
  EXPECT_NE(refusal(path).find("a TOML file has at most 4194304"), std::string::npos) << refusal(path);
}

TEST(TomlFile, SaysHowManyProblemsThereAreBesidesTheFirstTwenty) {
  std::string toml;
  for (int i = 0; i < 200'000; ++i) toml += "k" + std::to_string(i) + " = 1\n";
  const std::string text = complaint(toml, [](TableReader&) {});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 20);
  EXPECT_TRUE(text.ends_with(": 199980 more problems")) << text;
}

TEST(TomlFile, SpellsOutControlCharactersOfKeysAndShortensLongOnes) {
  EXPECT_EQ(complaint("\"\\u001b[31m\\n\" = 1", [](TableReader&) {}), ":1: \\x1b[31m\\n: unknown key");
  const std::string text = complaint(std::string(100'000, 'k') + " = 1", [](TableReader&) {});
  EXPECT_EQ(text, ":1: " + std::string(467, 'k') + "... (99313 more bytes) ..." + std::string(220, 'k') + ": unknown key");
}

TEST(TomlFile, ResolvesPathsAgainstItsOwnFolder) {
  const TomlFile file(written(""));
  EXPECT_EQ(file.resolve("../ocean.toml"), (file.path().parent_path() / "../ocean.toml").lexically_normal());
  EXPECT_EQ(file.resolve("/etc/ocean.toml"), "/etc/ocean.toml");
}

}  // namespace
}  // namespace earshot::host
