#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "firmware/wire/n2k/node/information.hpp"
#include "firmware/wire/n2k/node/node.hpp"

namespace earshot::n2k {
namespace {

constexpr Duration kTick = Duration::milliseconds(5);

/// Devices on one bus: what one sends, all others hear, each perhaps not.
class Bus {
 public:
  Bus(std::uint32_t seed, std::size_t devices, std::uint8_t addresses, bool echo) : random_(seed), echo_(echo) {
    for (std::size_t i = 0; i < devices; ++i) {
      Identity identity;
      identity.name = name_of({.unique_number = static_cast<std::uint32_t>(random_() % 1'000'000 * 64 % 2'000'000 + i)}).value();
      identity.preferred_address = static_cast<std::uint8_t>(random_() % addresses);
      names_.push_back(identity.name);
      nodes_.emplace_back(identity, table_pgns(PgnListKind::kTransmitted), table_pgns(PgnListKind::kReceived));
    }
  }

  void run(Duration time, double loss = 0.0) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const Time end = now_ + time; now_ < end; now_ = now_ + kTick) {
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        NodeFrames frames;
        nodes_[i].step(now_, frames);
        for (const Frame& frame : frames) {
          ++frames_;
          for (std::size_t j = 0; j < nodes_.size(); ++j) {
            if ((j != i || echo_) && share(random_) >= loss) nodes_[j].accept(frame, now_);
          }
        }
      }
    }
  }

  void say(const Frame& frame) {
    for (Node& node : nodes_) node.accept(frame, now_);
  }

  [[nodiscard]] std::map<Name, std::optional<std::uint8_t>> addresses() const {
    std::map<Name, std::optional<std::uint8_t>> all;
    for (std::size_t i = 0; i < nodes_.size(); ++i) all[names_[i]] = nodes_[i].address();
    return all;
  }
  [[nodiscard]] std::size_t frames() const { return frames_; }
  [[nodiscard]] const std::vector<Name>& names() const { return names_; }

 private:
  std::mt19937 random_;
  bool echo_;
  std::deque<Node> nodes_;
  std::vector<Name> names_;
  Time now_{1'000'000};
  std::size_t frames_ = 0;
};

void expect_all_apart(const Bus& bus, std::uint32_t seed) {
  std::set<std::uint8_t> seen;
  for (const auto& [name, address] : bus.addresses()) {
    ASSERT_TRUE(address.has_value()) << seed;
    ASSERT_TRUE(seen.insert(*address).second) << "two devices at " << int{*address} << ", seed " << seed;
  }
}

const Frame kWhoIsThere{0x18EAFFFE, 3, {0x00, 0xEE, 0x00}};

TEST(AddressClaimBus, GivesEveryDeviceAnAddressOfItsOwnHoweverManyWantTheSame) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    Bus bus(seed, 2 + seed % 40, static_cast<std::uint8_t>(1 + seed % 7), seed % 2 == 0);
    bus.run(Duration::seconds(4));
    expect_all_apart(bus, seed);
  }
}

TEST(AddressClaimBus, LetsTheLowestNameKeepTheAddressThatAllWant) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    Bus bus(seed, 10, 1, seed % 2 == 0);
    bus.run(Duration::seconds(4));
    // The plain model: sorted by NAME, they get one address after the other.
    std::uint8_t expected = 0;
    for (const auto& [name, address] : bus.addresses()) EXPECT_EQ(address, expected++) << seed;
  }
}

TEST(AddressClaimBus, LeavesTheHighestNamesWithoutAnAddressWhereMoreDevicesAreThanAddresses) {
  constexpr std::size_t kAddresses = kLastAddress + 1U;
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    Bus bus(seed, kAddresses + 3, 251, false);
    bus.run(Duration::seconds(10));
    // The plain model: as many as there are addresses have one each, those whose NAMEs come first.
    std::set<std::uint8_t> held;
    std::size_t place = 0;
    for (const auto& [name, address] : bus.addresses()) {
      EXPECT_EQ(address.has_value(), place++ < kAddresses) << seed;
      if (address) held.insert(*address);
    }
    EXPECT_EQ(place, kAddresses + 3) << "two with the same NAME, seed " << seed;
    EXPECT_EQ(held.size(), kAddresses) << seed;
    EXPECT_EQ(*held.rbegin(), kLastAddress) << seed;
  }
}

TEST(AddressClaimBus, ComesToOrderAfterFramesWereLost) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    Bus bus(seed, 12, 3, seed % 2 == 0);
    bus.run(Duration::seconds(2), 0.3);
    bus.say(kWhoIsThere);
    bus.run(Duration::seconds(4));
    expect_all_apart(bus, seed);
  }
}

TEST(AddressClaimBus, OutlivesAStormOfClaims) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    Bus bus(seed, 8, 3, false);
    std::mt19937 random(seed);
    for (int ms = 0; ms < 2000; ms += 5) {
      for (int i = 0; i < 10; ++i) {
        Frame claim{.identifier = 0x18EEFF00U | static_cast<std::uint32_t>(random() % 256U)};
        for (std::uint8_t& byte : claim.data) byte = static_cast<std::uint8_t>(random());
        bus.say(claim);
      }
      bus.run(kTick);
    }
    // Every claim may be answered by each of the eight, but none more often than each 20 ms: 100 in 2 s, and what they say of themselves.
    EXPECT_LE(bus.frames(), 8U * (100U + 20U));
    bus.say(kWhoIsThere);
    bus.run(Duration::seconds(35));
    expect_all_apart(bus, seed);
  }
}

}  // namespace
}  // namespace earshot::n2k
