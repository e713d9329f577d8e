#include "firmware/host/mission/authority/command_proof.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::host {
namespace {

using messages::OperatorCommand;

CommandProof proof_of(std::string_view vehicle, std::string_view mission, bool accepts_old_marks = false) {
  KeyBytes key{};
  key.fill(5);
  return {.key = CommandKey(key), .challenge = new_challenge(vehicle, sha256_of(mission)), .accepts_old_marks = accepts_old_marks};
}

/// A START, marked for a vehicle that told its challenge.
OperatorCommand start_for(const CommandProof& proof) {
  OperatorCommand command{.time = Time{1'795'000'000'000'000},
                          .expiry = Time{1'795'000'060'000'000},
                          .issuer = 7,
                          .number = 1,
                          .order = messages::Order::kStart};
  command.mark = proof.key.mark_of(command, proof.published(command.time).challenge);
  return command;
}

bool verifies(const CommandProof& proof, OperatorCommand command) {
  proof.judge(command);
  EXPECT_FALSE(command.is_verified && command.has_old_mark);
  return command.is_verified;
}

TEST(CommandProof, IsGivenByAnOrderThatIsMarkedForThisStartOfThisVehicle) {
  const CommandProof proof = proof_of("auv-7", "a mission");
  EXPECT_TRUE(verifies(proof, start_for(proof)));
}

TEST(CommandProof, IsNotGivenByAStartThatWasRecordedBeforeARestart) {
  const OperatorCommand recorded = start_for(proof_of("auv-7", "a mission"));
  EXPECT_FALSE(verifies(proof_of("auv-7", "a mission"), recorded)) << "of the same vehicle with the same mission, begun anew";
}

TEST(CommandProof, IsNotGivenByAStartThatWasRecordedOfAnotherVehicleOrMission) {
  CommandProof other = proof_of("auv-7", "a mission");
  const OperatorCommand recorded = start_for(other);
  other.challenge.vehicle = new_challenge("auv-8", {}).vehicle;
  EXPECT_FALSE(verifies(other, recorded)) << "not even with its nonce";
  other = proof_of("auv-7", "a mission");
  const OperatorCommand again = start_for(other);
  other.challenge.mission = sha256_of(std::string_view("another mission"));
  EXPECT_FALSE(verifies(other, again));
}

TEST(CommandProof, SaysOfAMarkWithoutAChallengeThatItIsOldUnlessItIsToCount) {
  CommandProof proof = proof_of("", "a mission");
  OperatorCommand command = start_for(proof);
  command.mark = proof.key.old_mark_of(command);
  proof.judge(command);
  EXPECT_FALSE(command.is_verified);
  EXPECT_TRUE(command.has_old_mark);
  proof.accepts_old_marks = true;
  proof.judge(command);
  EXPECT_TRUE(command.is_verified);
  EXPECT_FALSE(command.has_old_mark);
  command.mark[0] ^= 1U;
  proof.judge(command);
  EXPECT_FALSE(command.is_verified);
  EXPECT_FALSE(command.has_old_mark);
}

TEST(CommandProof, IsToldWithAMarkOfWhoKnowsTheKey) {
  const CommandProof proof = proof_of("auv-7", "a mission");
  messages::PublishedChallenge published = proof.published(Time{5});
  EXPECT_EQ(published.time, Time{5});
  EXPECT_TRUE(proof.key.verifies(published));
  published.challenge.nonce[0] ^= 1U;
  EXPECT_FALSE(proof.key.verifies(published));
}

TEST(NewChallenge, BearsTheVehiclesNameTheMissionAndANonceOfItsOwn) {
  const authority::Sha256 mission = sha256_of(std::string_view("a mission"));
  const messages::Challenge one = new_challenge("auv-7", mission);
  const messages::Challenge other = new_challenge("auv-7", mission);
  EXPECT_EQ(one.mission, mission);
  EXPECT_EQ(std::string(one.vehicle.begin(), one.vehicle.end()), "auv-7" + std::string(27, '\0'));
  EXPECT_EQ(one.vehicle, other.vehicle);
  EXPECT_NE(one.nonce, other.nonce);
  EXPECT_NE(one.nonce, messages::Nonce{});
  EXPECT_EQ(new_challenge("", mission).vehicle, messages::VehicleId{});
  const std::string longest(32, 'x');
  EXPECT_EQ(new_challenge(longest, mission).vehicle.back(), 'x');
}

}  // namespace
}  // namespace earshot::host
