#include "policy/evaluate/task.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/policy/evaluate/made_up_candidates.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::evaluate {
namespace {

const std::string kFixed =
    "environment = a.toml\nenvironment_crc32 = 01234567\nvehicle_depth_m = 300\nsource = fixed\nstart_margin_m = 0\nborder_width_m = 1000\n"
    "border_reward = -100\nmax_steps = 100\n";

class Task : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> of(const std::string& provenance) const {
    return differences(learned("p", provenance), {settings, depth, "01234567"});
  }

  search::SearchSettings settings;  // the paper's: fixed, starts in all of the domain, border of 1 km, 100 steps
  Meters depth{300.0};
};

TEST_F(Task, DiffersInNothingWhereAPolicyIsTestedAsItWasTrained) {
  EXPECT_EQ(of(kFixed), std::vector<std::string>{});
  EXPECT_EQ(differences({"oracle", nullptr}, {settings, depth, ""}), std::vector<std::string>{});
}

TEST_F(Task, SaysWhatIsTestedOtherwiseThanItWasTrained) {
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::inside_border(settings);
  settings.border_width = Meters{500.0};
  settings.border_reward = -40.0;
  settings.max_steps = 60;
  depth = Meters{200.0};
  EXPECT_TRUE(support::lines_tell(of(kFixed), {{"trained", "changing", "one"},
                                               {"trained", "anywhere", "1000 m"},
                                               {"1000 m", "500 m"},
                                               {"-100", "-40"},
                                               {"100 steps", "60"},
                                               {"300 m", "200 m"}}));
}

TEST_F(Task, OfAPolicyWithoutANetworkIsTheKindOfItsSourceAlone) {
  Candidate advised = learned("p", kFixed);
  advised.learned->network.hidden_sizes = {};
  settings.start_region = search::inside_border(settings);
  settings.max_steps = 60;
  depth = Meters{100.0};
  EXPECT_EQ(differences(advised, {settings, depth, "01234567"}), std::vector<std::string>{}) << "its tables are of that depth";
  settings.placement = search::SourcePlacement::kChanging;
  EXPECT_TRUE(support::lines_tell(differences(advised, {settings, depth, "01234567"}), {{"searches", "changing", "one"}}));
}

TEST_F(Task, SaysThatAFixedSourceStandsElsewhere) {
  settings.source = {Meters{3'000.0}, Meters{4'000.5}};
  EXPECT_TRUE(support::lines_tell(of(kFixed + "source_north_m = 10000\nsource_east_m = 10000\n"),
                                  {{"10000 m north", "10000 m east", "3000 m north", "4000.5 m east"}}));
  EXPECT_EQ(of(kFixed + "source_north_m = 3000\nsource_east_m = 4000.5\n"), std::vector<std::string>{});
  const std::vector<std::string> elsewhere = differences(learned("p", kFixed), {settings, depth, "76543210"});
  EXPECT_TRUE(support::lines_tell(elsewhere, {{"a.toml", "3000 m north", "4000.5 m east"}}));
}

TEST_F(Task, SaysThatAFileDoesNotNameItsSource) {
  EXPECT_TRUE(support::lines_tell(of(""), {{"not", "source", "trained", "tested"}}));
}

TEST_F(Task, KnowsTheStartsOfAPolicyTrainedInPython) {
  settings.placement = search::SourcePlacement::kChanging;
  EXPECT_EQ(of("source = changing\nstart = domain\n"), std::vector<std::string>{});
  EXPECT_TRUE(support::lines_tell(of("source = changing\nstart = inside_border\n"), {{"trained", "1000 m", "anywhere"}}));
}

TEST(TaskOfMany, IsThatOfTheFirstWhoseFileNamesItsSource) {
  const std::vector<Candidate> second_differs = both(learned("a", ""), learned("b", kFixed));
  EXPECT_EQ(leading(second_differs), &second_differs[2]);
  const std::vector<Candidate> none_differs = both(learned("a", ""), learned("b", "seed = 1\n"));
  EXPECT_EQ(leading(none_differs), &none_differs[1]);
  std::vector<Candidate> none_learned;
  none_learned.push_back({"oracle", nullptr});
  EXPECT_EQ(leading(none_learned), nullptr);
}

TEST(TaskOfMany, IsOfOneKindOfSource) {
  EXPECT_NO_THROW(check_same_source(both(learned("a", "source = fixed\n"), learned("b", ""))));
  EXPECT_NO_THROW(check_same_source(both(learned("a", ""), learned("b", ""))));
  EXPECT_THROW(check_same_source(both(learned("a", "source = fixed\n"), learned("b", "source = changing\n"))), host::BadInput);
}

}  // namespace
}  // namespace earshot::evaluate
