#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "firmware/host/trust/signature_file.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::support {

/// A folder's mission that flies signed_bytes()' policy, by keys that anyone can read here, and the vehicle that trusts them.
class SignedMission {
 public:
  explicit SignedMission(std::filesystem::path folder) : folder_(std::move(folder)) {
    ::umask(S_IWGRP | S_IWOTH);  // else the vehicle would refuse them
    key_.seed.fill(3);
    write_secret_file(folder_ / "ops.key", host::to_text(key_));
    std::ofstream(folder_ / "ops.pub") << host::to_text(host::public_key_of(key_));
    write_public_key(folder_ / "walk.pub");
    write_bytes(folder_ / "walk.policy", signed_bytes(random_walk_policy()));
    write_vehicle("");
  }

  /// @param more  lines of the table [trust]
  void write_vehicle(const std::string& more) const {
    std::ofstream(folder_ / "vehicle.toml") << "[trust]\npolicy_keys = [\"walk.pub\"]\nmission_keys = [\"ops.pub\"]\n"
                                               "counter_file = \"mission.counter\"\n"
                                            << more;
  }

  void write(const std::string& mission) const { std::ofstream(folder_ / "mission.toml") << mission; }
  void sign(std::uint64_t counter) const { sign(counter, key_); }
  void sign(std::uint64_t counter, const host::SecretKey& key) const { sign(counter, host::sha256_of(content("walk.policy")), key); }
  /// @param policy  the digest of policy and ocean tables (host::digest_of)
  void sign(std::uint64_t counter, const authority::Sha256& policy) const { sign(counter, policy, key_); }

  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  void sign(std::uint64_t counter, const authority::Sha256& policy, const host::SecretKey& key) const {
    const authority::MissionManifest manifest{.counter = counter, .mission = host::sha256_of(content("mission.toml")), .policy = policy};
    std::ofstream(folder_ / "mission.toml.sig") << host::to_text(host::sign(manifest, key));
  }

  std::filesystem::path folder_;
  host::SecretKey key_;
};

/// The text of a mission that ships, for the walking policy in its own folder, which hears the newest measurement.
[[nodiscard]] inline std::string mission_of_the_walk(std::string mission) {
  const auto replace = [&mission](std::string_view from, std::string_view to) {
    mission.replace(mission.find(from), from.size(), to);  // throws when it is not there
  };
  replace("listening = \"mean\"", "listening = \"newest\"");
  replace("listening_window_s = 30", "listening_window_s = 0");
  replace("../../../../policy/frozen/shipped.policy", "walk.policy");
  replace("public_key_file = \"../../../../policy/frozen/earshot.pub\"\n", "");
  return mission;
}

}  // namespace earshot::support
