#include "firmware/host/program/command_line.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/version.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::program {
namespace {

using Words = std::vector<std::string>;

/// A program with one option of each kind.
struct Example {
  std::uint64_t seed = 1;
  double depth_m = 300.0;
  double spacing_m = 0.0;
  std::optional<std::filesystem::path> out;
  std::vector<std::string> files;
  std::vector<double> band_hz;
  std::string bus = "lcm";
  bool map = false;
  CommandLine line{"earshot try", "Tries."};

  Example() {
    line.option("FILE", &files, "files");
    line.option("--seed", &seed, "seed").from(0, std::numeric_limits<std::int64_t>::max()).shows_default();
    line.option("--depth-m", &depth_m, "depth").between(0.0, 12'000.0);
    line.option("--spacing-m", &spacing_m, "spacing").positive();
    line.option("-o,--out", &out, "folder");
    line.option("--band-hz", &band_hz, "band").takes(2, 2).between(1.0, 1e4);
    line.option("--bus", &bus, "bus").one_of({"lcm", "can"});
    line.flag("--map", &map, "map").needs(line.at("--out"));
  }

  std::string complaint(const Words& words) {
    try {
      (void)line.read(words);
      return {};
    } catch (const host::BadInput& e) {
      return e.what();
    }
  }
};

TEST(CommandLine, GivesAnOptionOneValueEachTimeWhereItTakesNoMore) {
  Example e;
  std::vector<std::string> expected;
  e.line.option("--expected", &expected, "likely ones").one_each_time();
  EXPECT_EQ(e.line.read(Words{"--expected", "a", "b", "--expected", "c", "d"}), std::nullopt);
  EXPECT_EQ(expected, (Words{"a", "c"}));
  EXPECT_EQ(e.files, (Words{"b", "d"}));
}

TEST(CommandLine, RefusesTheEmptyWordWhereAFileMustBeNamed) {
  Example e;
  std::vector<std::string> tables;
  std::optional<std::filesystem::path> policy;
  e.line.option("--tables", &tables, "tables").names("a file or a folder");
  e.line.option("--policy", &policy, "policy").names("a file");
  EXPECT_TRUE(support::tells(e.complaint({"--tables", "a", ""}), {"try", "--tables", "--help"}));
  EXPECT_TRUE(support::tells(e.complaint({"--policy", ""}), {"try", "--policy", "--help"}));
  EXPECT_EQ(e.complaint({"--policy", "a"}), "");
}

TEST(CommandLine, TakesNoEmptyWordForAnyTextOrPath) {
  Example e;
  std::string text;
  std::filesystem::path path;
  std::optional<std::string> perhaps_text;
  std::optional<std::filesystem::path> perhaps_path;
  std::vector<std::string> texts;
  e.line.option("--text", &text, "text");
  e.line.option("--path", &path, "path");
  e.line.option("--perhaps-text", &perhaps_text, "text");
  e.line.option("--perhaps-path", &perhaps_path, "path");
  e.line.option("--texts", &texts, "texts");
  for (const char* option : {"--text", "--path", "--perhaps-text", "--perhaps-path", "--texts"})
    EXPECT_TRUE(
        support::tells(e.complaint({option, ""}), {"earshot", "try", std::string(option), "not", "empty", "earshot", "--help", "lists"}));
  EXPECT_TRUE(support::tells(e.complaint({""}), {"try", "FILE", "not", "empty", "--help"}));
}

TEST(CommandLine, PutsEveryValueWhereItBelongs) {
  Example e;
  EXPECT_EQ(e.line.read(Words{"a", "--seed", "7", "--depth-m=250.5", "-o", "out", "--band-hz", "10", "30", "--map", "--", "b"}),
            std::nullopt);
  EXPECT_EQ(e.seed, 7U);
  EXPECT_EQ(e.depth_m, 250.5);
  EXPECT_EQ(e.out, "out");
  EXPECT_EQ(e.band_hz, (std::vector<double>{10.0, 30.0}));
  EXPECT_EQ(e.files, (Words{"a", "b"}));
  EXPECT_TRUE(e.map);
  EXPECT_EQ(e.line.given(), (Words{"FILE", "--seed", "--depth-m", "--out", "--band-hz", "--map"}));
}

TEST(CommandLine, ReadsWhatFollowsTheProgramsName) {
  Example e;
  const std::array<const char*, 3> words{"earshot-try", "--seed", "7"};
  EXPECT_EQ(e.line.read(3, words.data()), std::nullopt);
  EXPECT_EQ(e.seed, 7U);
  EXPECT_EQ(Example().line.read(1, words.data()), std::nullopt);
  EXPECT_EQ(Example().line.read(0, words.data()), std::nullopt) << "a caller may even leave out the name";
}

TEST(CommandLine, KeepsTheBoundsOfARange) {
  EXPECT_EQ(Example().complaint({"--depth-m", "0"}), "");
  EXPECT_EQ(Example().complaint({"--depth-m", "12000"}), "");
  EXPECT_TRUE(support::tells(Example().complaint({"--depth-m=-0.001"}), {"try", "--depth-m", "-0.001", "0 to 12000", "--help"}));
  EXPECT_TRUE(support::tells(Example().complaint({"--depth-m", "12000.1"}), {"try", "--depth-m", "12000.1", "0 to 12000", "--help"}));
  EXPECT_EQ(Example().complaint({"--spacing-m", "0.5"}), "");
  EXPECT_TRUE(support::tells(Example().complaint({"--spacing-m", "0"}), {"try", "--spacing-m", "0", "greater than 0", "--help"}));
}

TEST(CommandLine, TakesZeroWhereOnlyLessIsRefused) {
  double margin_m = 1.0;
  CommandLine line("earshot try", "Tries.");
  line.option("--margin-m", &margin_m, "margin").not_negative();
  EXPECT_EQ(line.read(Words{"--margin-m", "0"}), std::nullopt);
  EXPECT_EQ(margin_m, 0.0);
  EXPECT_THROW((void)line.read(Words{"--margin-m=-0.1"}), host::BadInput);
}

TEST(CommandLine, TakesAsManyValuesAsItIsToldTo) {
  std::vector<double> at_m;
  std::vector<std::string> names;
  CommandLine line("earshot try", "Tries.");
  line.option("--at-m", &at_m, "places").takes(2, 3);
  line.option("--names", &names, "names").separated_by(',');
  EXPECT_THROW((void)line.read(Words{"--at-m", "1"}), host::BadInput);
  EXPECT_EQ(line.read(Words{"--at-m", "1", "2", "3", "--names", "fin,blue"}), std::nullopt);
  EXPECT_EQ(at_m, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(names, (Words{"fin", "blue"}));
  EXPECT_THROW((void)line.read(Words{"--at-m", "1", "2", "3", "4"}), host::BadInput);
}

TEST(CommandLine, NamesTheOptionThatWasMeant) {
  EXPECT_TRUE(support::tells(Example().complaint({"--sed", "3"}), {"try", "--sed", "no", "mean --seed", "--help"}));
  EXPECT_TRUE(support::tells(Example().complaint({"--sed=3"}), {"try", "--sed", "no", "mean --seed", "--help"}));
  EXPECT_TRUE(support::tells(Example().complaint({"--whatever"}), {"try", "--whatever", "no", "--help"}));
  EXPECT_TRUE(support::tells(Example().complaint({"-x"}), {"try", "no", "--help"}));
}

TEST(CommandLine, NamesTheUnknownOptionRatherThanTheOneThatIsMissingForIt) {
  CommandLine line("earshot try", "");
  std::string environment;
  line.option("--environment", &environment, "").required();
  try {
    (void)line.read(Words{"--enviroment", "x.toml"});
    FAIL();
  } catch (const host::BadInput& e) {
    EXPECT_TRUE(support::has_line(std::string(e.what()), {"--enviroment", "no", "mean --environment"})) << e.what();
  }
}

TEST(CommandLine, RefusesNumbersThatAreNone) {
  for (const char* value : {"nan", "NaN", "-nan", "inf", "1e999", "12000.1", "-0.1", "deep", "", "3 m"})
    EXPECT_NE(Example().complaint({"--depth-m", value}).find("must be a number from 0 to 12000"), std::string::npos) << value;
  for (const char* value : {"nan", "inf", "0", "-1"})
    EXPECT_NE(Example().complaint({"--spacing-m", value}).find("must be a number greater than 0"), std::string::npos) << value;
  for (const char* value : {"nan", "1.5", "-1", "9223372036854775808"})
    EXPECT_NE(Example().complaint({"--seed", value}).find("must be a whole number from 0 to"), std::string::npos) << value;
  EXPECT_NE(Example().complaint({"--band-hz", "20", "nan"}).find("must be a number from 1 to 10000"), std::string::npos);
}

TEST(CommandLine, RefusesAWholeNumberThatDoesNotFitItsTarget) {
  std::uint64_t steps = 0;
  std::optional<std::uint32_t> most;
  for (const Words& words : {Words{"--steps", "18446744073709551616"}, Words{"--steps", "-1"}, Words{"--most", "4294967296"}}) {
    CommandLine line("earshot try", "");
    line.option("--steps", &steps, "");
    line.option("--most", &most, "");
    EXPECT_THROW((void)line.read(words), host::BadInput) << words[1];
  }
}

TEST(CommandLine, SaysWhatIsAllowedRatherThanWhatItsTargetHolds) {
  for (const char* value : {"-1", "1.5", "121", "4294967296"}) {
    std::optional<std::uint32_t> window_s;
    CommandLine line("earshot try", "");
    line.option("--window-s", &window_s, "").from(1, 120);
    try {
      (void)line.read(Words{"--window-s", value});
      FAIL() << value;
    } catch (const host::BadInput& e) {
      EXPECT_NE(std::string(e.what()).find(std::string(value) + ": must be a whole number from 1 to 120"), std::string::npos) << e.what();
    }
  }
}

TEST(CommandLine, TakesTheGreatestSeed) {
  Example e;
  EXPECT_EQ(e.complaint({"--seed", "9223372036854775807"}), "");
  EXPECT_EQ(e.seed, 9'223'372'036'854'775'807U);
}

TEST(CommandLine, SaysWhichWordsAreAllowed) {
  EXPECT_TRUE(support::has_line(Example().complaint({"--bus", "cna"}), {"cna", "lcm", "can", "mean can"}));
}

TEST(CommandLine, TakesAWordThatIsAllowed) {
  Example e;
  EXPECT_EQ(e.line.read(Words{"--bus", "can"}), std::nullopt);
  EXPECT_EQ(e.bus, "can");
}

TEST(CommandLine, TakesALoneDashForAWord) {
  Example e;
  EXPECT_EQ(e.line.read(Words{"-"}), std::nullopt);
  EXPECT_EQ(e.files, (Words{"-"}));
}

TEST(CommandLine, RefusesAnOptionWithoutTheOneItNeeds) {
  EXPECT_NE(Example().complaint({"--map"}), "");
}

TEST(CommandLine, AnswersHelpAndVersion) {
  EXPECT_EQ(Example().line.read(Words{"--version"}), program::version_line("earshot try", program::version(), build_commit()) + "\n");
  const std::string help = Example().line.read(Words{"--help"}).value();
  for (const char* part : {"Tries.", "--seed", "--quiet", "--verbose", "--version"}) EXPECT_NE(help.find(part), std::string::npos) << part;
}

TEST(CommandLine, SettingsAreWhatWasGivenAndTheDefaultsThatHelpShows) {
  Example e;
  EXPECT_EQ(e.line.read(Words{"a", "--band-hz", "10", "30", "--verbose"}), std::nullopt);
  EXPECT_EQ(e.line.settings(), "  FILE a\n  --seed 1 (default)\n  --band-hz 10 30\n");
  CommandLine program("earshot try", "Tries.");
  double depth_m = 300.0;
  CommandLine& verb = program.verb("map", "draws");
  verb.option("--depth-m", &depth_m, "depth").shows_default();
  program.verb("sheet", "writes").option("--step", &e.seed, "step").shows_default();
  EXPECT_EQ(program.read(Words{"map"}), std::nullopt);
  EXPECT_EQ(program.settings(), "  map\n  --depth-m 300 (default)\n");
}

TEST(CommandLine, TellsHowMuchIsToBeSaid) {
  Example normal;
  Example quiet;
  Example verbose;
  (void)normal.line.read(Words{});
  (void)quiet.line.read(Words{"--quiet"});
  (void)verbose.line.read(Words{"--verbose"});
  EXPECT_EQ(normal.line.talk(), Talk::kNormal);
  EXPECT_EQ(quiet.line.talk(), Talk::kQuiet);
  EXPECT_EQ(verbose.line.talk(), Talk::kVerbose);
  EXPECT_EQ(verbose.line.given(), Words{});
  EXPECT_EQ(quiet.line.given(), Words{});
  EXPECT_NE(Example().complaint({"--quiet", "--verbose"}), "");
}

struct TwoVerbs {
  CommandLine line{"earshot try", "Tries."};
  std::string source;
  CommandLine& map = line.verb("map", "draws");
  CommandLine& decision = line.verb("decision", "says why");

  TwoVerbs() { map.option("--source", &source, "where"); }
};

TEST(CommandLine, KnowsWhichVerbWasChosen) {
  TwoVerbs v;
  EXPECT_EQ(v.line.read(Words{"map", "--source", "-3,4", "--quiet"}), std::nullopt);
  EXPECT_TRUE(v.map.is_chosen());
  EXPECT_FALSE(v.decision.is_chosen());
  EXPECT_EQ(v.source, "-3,4");
  EXPECT_EQ(v.line.talk(), Talk::kQuiet);
}

TEST(CommandLine, NamesTheVerbOrTheVerbsOptionThatWasMeant) {
  const auto complaint = [](const Words& words) -> std::string {
    try {
      (void)TwoVerbs().line.read(words);
      return {};
    } catch (const host::BadInput& e) {
      return e.what();
    }
  };
  EXPECT_NE(complaint({"mpa"}).find("mpa: no such verb; did you mean map?"), std::string::npos) << complaint({"mpa"});
  // --source is no option of the verb that was given.
  EXPECT_EQ(complaint({"decision", "--sorce", "1,2"}).find("did you mean"), std::string::npos) << complaint({"decision", "--sorce", "1,2"});
  EXPECT_TRUE(support::has_line(complaint({"map", "--sorce", "1,2"}), {"--sorce", "no", "mean --source"}));
  EXPECT_NE(complaint({}), "");
}

TEST(AsTyped, IsTheProgramWithoutItsFolderAndAllItWasGiven) {
  const std::vector<const char*> words{"/usr/bin/earshot", "fly", "--seed", "3"};
  EXPECT_EQ(as_typed(static_cast<int>(words.size()), words.data()), "earshot fly --seed 3");
  EXPECT_EQ(as_typed(1, words.data()), "earshot");
}

TEST(VersionLine, SaysWhetherTheTreeWasClean) {
  EXPECT_TRUE(support::tells(version_line("earshot", "1.2.3", "abc123"), {"1.2.3", "abc123", "clean"}));
  EXPECT_TRUE(support::tells(version_line("earshot", "1.2.3", "abc123-dirty"), {"1.2.3", "abc123", "changes", "no"}));
  EXPECT_EQ(version_line("earshot", "1.2.3", "unknown"), "earshot 1.2.3 (commit unknown)");
}

}  // namespace
}  // namespace earshot::program
