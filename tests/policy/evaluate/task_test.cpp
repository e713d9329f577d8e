#include "policy/evaluate/task.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/policy/evaluate/made_up_candidates.hpp"

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
  EXPECT_EQ(of(kFixed),
            (std::vector<std::string>{
                "p was trained with a fixed source and is tested with a changing one: another search than it is made for",
                "p was trained from starts anywhere in the domain and is tested from starts 1000 m or more from every edge",
                "p was trained with a border of 1000 m and is tested with one of 500 m",
                "p was trained with a reward of -100 at the edge and is tested with -40",
                "p was trained to search for 100 steps and is tested over 60", "p was trained 300 m deep and is tested 200 m deep"}));
}

TEST_F(Task, OfAPolicyWithoutANetworkIsTheKindOfItsSourceAlone) {
  Candidate advised = learned("p", kFixed);
  advised.learned->network.hidden_sizes = {};
  settings.start_region = search::inside_border(settings);
  settings.max_steps = 60;
  depth = Meters{100.0};
  EXPECT_EQ(differences(advised, {settings, depth, "01234567"}), std::vector<std::string>{}) << "its tables are of that depth";
  settings.placement = search::SourcePlacement::kChanging;
  EXPECT_EQ(
      differences(advised, {settings, depth, "01234567"}),
      (std::vector<std::string>{"p is made for searches with a fixed source and is tested with a changing one: another search than it "
                                "is made for"}));
}

TEST_F(Task, SaysThatAFixedSourceStandsElsewhere) {
  settings.source = {Meters{3'000.0}, Meters{4'000.5}};
  EXPECT_EQ(of(kFixed + "source_north_m = 10000\nsource_east_m = 10000\n"),
            (std::vector<std::string>{"p was trained with the source at 10000 m north, 10000 m east and is tested with it at 3000 m north, "
                                      "4000.5 m east: another search than it is made for"}));
  EXPECT_EQ(of(kFixed + "source_north_m = 3000\nsource_east_m = 4000.5\n"), std::vector<std::string>{});
  const std::vector<std::string> elsewhere = differences(learned("p", kFixed), {settings, depth, "76543210"});
  EXPECT_EQ(elsewhere, (std::vector<std::string>{"p was trained with the source where a.toml had it and is tested with it at 3000 m north, "
                                                 "4000.5 m east, where another environment puts it"}));
}

TEST_F(Task, SaysThatAFileDoesNotNameItsSource) {
  EXPECT_EQ(of(""), (std::vector<std::string>{"p does not state which source it was trained with and is tested with a fixed one"}));
}

TEST_F(Task, KnowsTheStartsOfAPolicyTrainedInPython) {
  settings.placement = search::SourcePlacement::kChanging;
  EXPECT_EQ(of("source = changing\nstart = domain\n"), std::vector<std::string>{});
  EXPECT_EQ(of("source = changing\nstart = inside_border\n"),
            (std::vector<std::string>{
                "p was trained from starts 1000 m or more from every edge and is tested from starts anywhere in the domain"}));
}

TEST(TaskOfMany, IsThatOfTheFirstWhoseFileNamesItsSource) {
  const std::vector<Candidate> second_says = both(learned("a", ""), learned("b", kFixed));
  EXPECT_EQ(leading(second_says), &second_says[2]);
  const std::vector<Candidate> none_says = both(learned("a", ""), learned("b", "seed = 1\n"));
  EXPECT_EQ(leading(none_says), &none_says[1]);
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
