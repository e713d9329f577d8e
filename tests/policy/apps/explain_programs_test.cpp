// earshot explain and earshot report as a person meets them.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/policy/apps/programs.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::policy_programs {
namespace {

/// With a flight in the test's folder.
class ExplainPrograms : public Programs {
 protected:
  ExplainPrograms() {
    const auto policy = explain::belief_policy(1);
    report::write_flight(folder / "flight", *policy, explain::flown(*policy, 4, {}), {});
  }
  [[nodiscard]] std::string content(const std::string& name) const { return support::read_text(folder / name); }
  /// What a page was given.
  [[nodiscard]] nlohmann::json flight_in(const std::string& page) const {
    const std::string text = content(page);
    const std::size_t begin = text.find("{\"format\":");
    if (begin == std::string::npos) return nullptr;
    return nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
  }
};

TEST_F(ExplainPrograms, HelpNeedsNothingThatShips) {
  ::setenv("EARSHOT_DATA", (folder / "nothing").c_str(), 1);
  for (const std::string words : {"explain --help", "explain map --help", "explain decision --help", "report --help"})
    EXPECT_EQ(run(words), 0) << words << ": " << content("err");
  ::unsetenv("EARSHOT_DATA");
}

TEST_F(ExplainPrograms, ExplainWritesAReportInEachFormatAndTheReportOfTheFlight) {
  ASSERT_EQ(run("explain decision flight --step 2 -o decision.html"), 0) << content("err");
  EXPECT_EQ(content("out").find("Integrated gradients"), std::string::npos) << content("out");
  EXPECT_EQ(flight_in("decision.html")["open_at_step"], 2);
  ASSERT_EQ(run("explain decision flight --step 2 -o decision.html --verbose"), 0) << content("err");
  EXPECT_NE((content("out") + content("err")).find("Integrated gradients: "), std::string::npos) << content("out");
  ASSERT_EQ(run("explain decision flight/journal.lcmlog --baseline here --step 2 -o decision.md"), 0) << content("err");
  EXPECT_TRUE(support::has_line(content("decision.md"), {"vehicle", "same place", "heard nothing"}));
  ASSERT_EQ(run("explain decision flight --step 3 -o decision.json"), 0) << content("err");
  EXPECT_EQ(nlohmann::json::parse(content("decision.json"))["step"], 3);
  ASSERT_EQ(run("report flight"), 0) << content("err");
  EXPECT_EQ(flight_in("flight/report.html")["open_at_step"], nullptr);
  ASSERT_EQ(run("report flight --json flight.json"), 0) << content("err");
  EXPECT_EQ(nlohmann::json::parse(content("flight.json")), flight_in("flight/report.html"));
  EXPECT_EQ(flight_in("flight/report.html")["decisions"][3]["reasons"].empty(), false);
}

TEST_F(ExplainPrograms, SayWhichFileTheyWrote) {
  ASSERT_EQ(run("explain decision flight --step 2 -o decision.html"), 0) << content("err");
  EXPECT_TRUE(support::has_line(content("out"), {"decision.html", "step 2", "flight/journal.lcmlog"})) << content("out");
  ASSERT_EQ(run("report flight"), 0) << content("err");
  EXPECT_TRUE(content("out").starts_with("wrote flight/report.html: 4 steps, 4 decisions\n")) << content("out");
}

TEST_F(ExplainPrograms, ReportSaysThatThePolicyIsMissingOrCutAndEndsWithOne) {
  const fs::path policy = folder / "flight/journal.policy";
  fs::resize_file(policy, fs::file_size(policy) / 2);
  EXPECT_EQ(run("report flight"), 1) << content("err");
  EXPECT_TRUE(support::has_line(content("err"), {"journal.policy", "the page is without"})) << content("err");
  fs::remove(policy);
  EXPECT_EQ(run("report flight --force"), 1) << content("err");
  EXPECT_TRUE(support::has_line(content("err"), {"journal.policy", "the page is without"})) << content("err");
}

TEST_F(ExplainPrograms, ExplainReplacesNoFileThatItReads) {
  fs::copy_file(folder / "flight/journal.policy", folder / "read.png");
  refuses("explain map read.png --source 10000,10000 --force -o read.png", {"POLICY read.png, --output read.png: the same file"});
  fs::copy_file(folder / "flight/journal.tables", folder / "tables.png");
  refuses("explain map flight/journal.policy --tables tables.png --source 10000,10000 --force -o tables.png",
          {"--tables tables.png, --output"});
  refuses("explain decision flight --step 2 --force -o flight/summary.json", {"flight/summary.json", "the same file"});
  for (const char* name : {"journal.lcmlog", "journal.policy", "journal.tables", "snr.csv"}) {
    fs::create_hard_link(folder / "flight" / name, folder / "hard.md");
    const std::string told = "FLIGHT flight/" + std::string(name) + ", --output hard.md: the same file";
    refuses("explain decision flight --step 2 --force -o hard.md", {told});
    fs::remove(folder / "hard.md");
  }
  fs::create_symlink("flight/journal.lcmlog", folder / "link.svg");
  refuses("explain map flight/journal.policy --flight flight --force -o link.svg", {"flight/journal.lcmlog, --output link.svg: the same"});
  write_ocean_with_section(folder / "e.toml", folder / "section.png");
  refuses("explain map flight/journal.policy --source 10000,10000 --environment e.toml --force -o section.png", {"section.png: the same"});
  EXPECT_TRUE(content("section.png").starts_with("range_m,depth_m"));
}

TEST_F(ExplainPrograms, ReportReplacesNoFileOfItsFlight) {
  for (const char* name : {"journal.lcmlog", "journal.policy", "journal.tables", "summary.json", "track.csv", "snr.csv"}) {
    const std::string before = content(std::string("flight/") + name);
    fs::create_symlink(name, folder / "flight/report.html");
    refuses("report flight --force", {"flight/" + std::string(name) + ", the page flight/report.html: the same file"});
    fs::remove(folder / "flight/report.html");
    EXPECT_EQ(content(std::string("flight/") + name), before);
  }
  fs::rename(folder / "flight/journal.lcmlog", folder / "flight/journal.html");
  refuses("report flight/journal.html --force", {"flight/journal.html, the page flight/journal.html: the same file"});
}

TEST_F(ExplainPrograms, ExplainDrawsMapsForASourceAndAlongAFlight) {
  ASSERT_EQ(run("explain map flight/journal.policy --source 10000,10000 --arrows 6 --starts 3 -o own.png"), 0) << content("err");
  ASSERT_EQ(run("explain map flight/journal.policy --source 10000,10000 --arrows 6 --starts 3" + kOcean + " -o paper.svg"), 0)
      << content("err");
  ASSERT_EQ(run("explain map flight/journal.policy --flight flight --step 3 --arrows 6 -o belief.png"), 0) << content("err");
  EXPECT_EQ(content("own.png").substr(1, 3), "PNG");
  // As munk_flat.toml and the default of --vehicle-depth-m have it.
  EXPECT_NE(content("paper.svg").find("What journal.policy does: source of 20 Hz, 30 m deep; vehicle 300 m deep"), std::string::npos);
  EXPECT_NE(content("paper.svg").find(" of 9 starts"), std::string::npos) << "3 x 3 paths of a policy with a belief";
  EXPECT_NE(content("own.png"), content("belief.png"));
}

TEST_F(ExplainPrograms, ExplainSearchesByTheTablesThatItIsGiven) {
  ASSERT_EQ(run("explain map flight/journal.policy --source 10000,10000 --starts 3 -o shipped.svg"), 0) << content("err");
  ASSERT_EQ(run("explain map flight/journal.policy --source 10000,10000 --starts 3 --tables flight/journal.tables -o own.svg"), 0)
      << content("err");
  EXPECT_TRUE(support::has_line(content("own.svg"), {"heard", "likeliest", "ocean"}));
  EXPECT_NE(content("own.svg"), content("shipped.svg"));
  fs::rename(folder / "flight" / "journal.tables", folder / "moved.tables");
  refuses("explain decision flight --step 2 -o a.md", {"no tables beside it (journal.tables)", "--tables FILE"});
  EXPECT_EQ(run("explain decision flight --step 2 --tables moved.tables -o a.md"), 0) << content("err");
}

TEST_F(ExplainPrograms, RefuseWhatTheyCannotExplainWithOneLine) {
  refuses("explain decision flight --step 4 -o a.html", {"--step 4", "journal.lcmlog", "step 3"});
  refuses("explain decision flight --step 1 -o a.pdf", {"a.pdf", ".html"});
  refuses("explain decision flight --step 1 --south-west 0x0 -o a.html", {"--south-west", "metres north"});
  refuses("explain decision nowhere --step 1 -o a.html", {"nowhere"});
  refuses("explain decision flight/track.csv --step 1 -o a.html", {"track.csv", "not a journal"});
  refuses("explain decision flight --policy flight/snr.csv --step 1 -o a.html", {"snr.csv", "not a .policy file"});
  refuses("explain decision flight --tables flight/snr.csv --step 1 -o a.html", {"snr.csv", "not a .tables file"});
  refuses("explain map flight/journal.policy --source 0,0 --tables flight/snr.csv -o a.png", {"snr.csv", "not a .tables file"});
  refuses("explain map flight/journal.policy --source 0,0 --tables none.tables -o a.png", {"none.tables", "no such file"});
  refuses("explain map flight/journal.policy -o a.png", {"--source", "--flight"});
  refuses("explain map flight/journal.policy --source 1 -o a.png", {"--source 1", "metres north"});
  refuses("explain map flight/journal.policy --source 1e300,1e300 -o a.png", {"--source 1e300,1e300", "0,0 to 25000,25000 m"});
  refuses("explain map flight/journal.policy --source 10000,25001 -o a.png", {"--source 10000,25001", "outside the policy's area"});
  refuses("explain map flight/journal.policy --source=-100,0 -o a.png", {"--source -100,0", "outside the policy's area"});
  refuses("explain map flight/journal.policy --source 0,0 --world flight/snr.csv -o a.png", {"snr.csv"});
  refuses("explain map flight/journal.policy --source 0,0 --environment flight/snr.csv -o a.png", {"snr.csv"});
  refuses("explain map flight/journal.policy --source 0,0 -o a.pdf", {"a.pdf", ".png"});
  refuses("explain map nothing.policy --source 0,0 -o a.png", {"nothing.policy", "no such file"});
}

TEST_F(ExplainPrograms, TakePlacesInMetresOrWithAUnitAndAskWhetherKilometresWereMeant) {
  const std::string map = "explain map flight/journal.policy --starts 2 -o ";
  refuses(map + "a.svg --source 10,10",
          {"--source 10,10: metres are meant: did you mean 10000,10000 (or 10km,10km)? If not, write 10m,10m"});
  refuses(map + "a.svg --source 99.5,-3", {"did you mean 99500,-3000"});
  refuses("explain decision flight --step 1 --south-west 12.5,3 -o a.html", {"--south-west 12.5,3: metres are meant"});
  refuses(map + "a.svg --source 10mm,10", {"--source 10mm,10: two lengths are needed"});
  refuses(map + "a.svg --source 10km10km", {"two lengths are needed"});
  refuses(map + "a.svg --source 10nmi,10nmi", {"two lengths are needed"});
  ASSERT_EQ(run(map + "metres.svg --source 10000,10000"), 0) << content("err");
  ASSERT_EQ(run(map + "kilometres.svg --source 10km,10km"), 0) << content("err");
  EXPECT_EQ(content("metres.svg"), content("kilometres.svg"));
  EXPECT_EQ(run(map + "corner.svg --source 10m,10m"), 0) << content("err");
  EXPECT_EQ(run(map + "corner.svg --source 0,0"), 0) << content("err");
}

TEST_F(ExplainPrograms, SayNothingWithQuietAndMoreWithVerbose) {
  for (const std::string words : {"explain decision flight --step 2 -o decision.html",
                                  "explain map flight/journal.policy --source 10000,10000 --starts 2 -o a.svg", "report flight"}) {
    ASSERT_EQ(run(words + " --quiet"), 0) << content("err");
    EXPECT_EQ(content("out") + content("err"), "") << words;
    ASSERT_EQ(run(words), 0) << content("err");
    const std::string said = content("out") + content("err");
    ASSERT_EQ(run(words + " --verbose"), 0) << content("err");
    EXPECT_GT((content("out") + content("err")).size(), said.size()) << words;
    const std::string file = words.starts_with("report") ? "flight: 4 decisions" : "flight/journal.policy: ";
    EXPECT_NE(content("err").find(file), std::string::npos) << content("err");
  }
}

TEST_F(ExplainPrograms, RefuseAFlightWithAnSnrCurveThatStandsStill) {
  std::ofstream(folder / "flight" / "snr.csv") << "range_m,snr_db\n0,30\n0,29\n";
  refuses("report flight", {"snr.csv:3", "same step"});
}

TEST_F(ExplainPrograms, RefuseAFlightWhoseSummaryDoesNotSayAllAndNameIt) {
  std::ofstream(folder / "flight" / "summary.json") << R"({"found": true})";
  refuses("report flight", {"flight/summary.json: ", "steps: must be a whole number"});
}

TEST_F(ExplainPrograms, RefuseAMapOfAPolicyThatKnowsNoOceanUntilOneIsNamed) {
  const auto policy = explain::place_policy(1);
  report::write_flight(folder / "flight", *policy, explain::flown(*policy, 2, {}), {});
  refuses("explain map flight/journal.policy --source 0,0 -o a.png", {"--environment", "journal.policy"});
  refuses("explain map flight/journal.policy --flight flight -o a.png", {"--flight", "no belief"});
}

}  // namespace
}  // namespace earshot::policy_programs
