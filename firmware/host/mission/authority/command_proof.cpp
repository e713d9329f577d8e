#include "firmware/host/mission/authority/command_proof.hpp"

#include <sodium.h>

#include <algorithm>

namespace earshot::host {

messages::Challenge new_challenge(std::string_view vehicle_id, const authority::Sha256& mission) {
  ready_libsodium();
  messages::Challenge challenge;
  randombytes_buf(challenge.nonce.data(), challenge.nonce.size());
  std::copy_n(vehicle_id.begin(), std::min(vehicle_id.size(), challenge.vehicle.size()), challenge.vehicle.begin());
  challenge.mission = mission;
  return challenge;
}

std::string vehicle_id_of(const messages::Challenge& challenge) {
  return {challenge.vehicle.begin(), std::ranges::find(challenge.vehicle, 0)};
}

void CommandProof::judge(messages::OperatorCommand& command) const {
  const bool is_old = key.verifies_old(command);
  command.is_verified = key.verifies(command, challenge) || (is_old && accepts_old_marks);
  command.has_old_mark = is_old && !command.is_verified;
}

messages::PublishedChallenge CommandProof::published(Time utc) const {
  return {.time = utc, .challenge = challenge, .mark = key.mark_of(challenge, utc)};
}

}  // namespace earshot::host
