#include "policy/ppo/checkpoint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "firmware/config_file/table_reader.hpp"

namespace earshot::ppo {
namespace {

Checkpoint made_up() {
  Checkpoint checkpoint;
  checkpoint.observation.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}});
  checkpoint.direction_count = 8;
  checkpoint.step_length = Meters{1'000.0};
  checkpoint.area_size = {Meters{25'000.0}, Meters{30'000.0}};
  checkpoint.detection_threshold = Decibels{11.0};
  checkpoint.provenance = {{"seed", "1"}, {"command", "say \"when\""}};
  Pcg32 random(1);
  ActorCritic<float> networks(checkpoint.shape());
  networks.initialise(random);
  checkpoint.parameters.assign(networks.parameters().begin(), networks.parameters().end());
  return checkpoint;
}

std::string refusal(const std::string& text) {
  try {
    (void)from_text(text, "a.checkpoint");
  } catch (const config_file::BadInput& e) {
    return e.what();
  }
  return "accepted";
}

std::string refusal_with(const std::string& key, const nlohmann::json& value) {
  nlohmann::json json = nlohmann::json::parse(to_text(made_up()));
  json[key] = value;
  return refusal(json.dump());
}

TEST(Checkpoint, SurvivesItsTextExactly) {
  const Checkpoint written = made_up();
  const Checkpoint read = from_text(to_text(written), "a");
  EXPECT_EQ(read.parameters, written.parameters);
  EXPECT_EQ(read.provenance, written.provenance);
  EXPECT_TRUE(std::ranges::equal(read.observation.spec, written.observation.spec));
  EXPECT_EQ(read.direction_count, written.direction_count);
  EXPECT_EQ(read.step_length, written.step_length);
  EXPECT_EQ(read.area_size, written.area_size);
  EXPECT_EQ(read.detection_threshold, written.detection_threshold);
}

TEST(Checkpoint, IsRefusedWhenCutShortAnywhere) {
  const std::string whole = to_text(made_up());
  for (std::size_t size = 0; size + 2 < whole.size(); size += 1'009) {
    EXPECT_EQ(refusal(whole.substr(0, size)), "a.checkpoint: not a checkpoint, or cut short");
  }
}

TEST(Checkpoint, IsRefusedWithTheFileAndThePartThatIsWrong) {
  EXPECT_NE(refusal_with("format", "other").find("a.checkpoint: not an earshot checkpoint"), std::string::npos);
  EXPECT_NE(refusal_with("direction_count", 0).find("direction_count"), std::string::npos);
  EXPECT_NE(refusal_with("direction_count", -1).find("direction_count"), std::string::npos);
  EXPECT_NE(refusal_with("step_length_m", -5).find("step_length_m"), std::string::npos);
  EXPECT_NE(refusal_with("area_north_m", 0).find("area_north_m"), std::string::npos);
  EXPECT_NE(refusal_with("area_east_m", -1).find("area_east_m"), std::string::npos);
  EXPECT_NE(refusal_with("parameters", {1.0, 2.0}).find("parameters: 2 numbers, its shape needs 9"), std::string::npos);
  EXPECT_NE(refusal_with("observation", nlohmann::json::array()).find("observation"), std::string::npos);
  EXPECT_NE(refusal_with("observation", {{{"feature", 99}, {"age", 0}, {"offset", 0}, {"scale", 1}}}).find("unknown feature"),
            std::string::npos);
  EXPECT_NE(refusal_with("provenance", 7), "accepted");
  EXPECT_NE(refusal("[]"), "accepted");
  EXPECT_NE(refusal("{}"), "accepted");
}

}  // namespace
}  // namespace earshot::ppo
