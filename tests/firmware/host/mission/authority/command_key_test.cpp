#include "firmware/host/mission/authority/command_key.hpp"

#include <gtest/gtest.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

using messages::CommandMark;
using messages::OperatorCommand;
using messages::Order;

CommandKey key() {
  KeyBytes bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  return CommandKey(bytes);
}

OperatorCommand start() {
  return {.time = Time{1'795'000'000'000'000},
          .expiry = Time{1'795'000'600'000'000},
          .issuer = 0xFEDC'BA98,
          .number = 7,
          .order = Order::kStart};
}

OperatorCommand tighten() {
  OperatorCommand command = start();
  command.order = Order::kTighten;
  command.limits = {.max_depth = Meters{100.0}, .max_speed = MetersPerSecond{1.25}, .max_time_s = 3600.0};
  return command;
}

messages::Challenge challenge() {
  messages::Challenge challenge{.nonce = {}, .vehicle = {'a', 'u', 'v', '-', '7'}, .mission = sha256_of(std::string_view("a mission\n"))};
  for (std::size_t i = 0; i < challenge.nonce.size(); ++i) challenge.nonce[i] = static_cast<std::uint8_t>(0x10 + i);
  return challenge;
}

// All by Python, order = struct.pack("<qqIIB3d", ...), told = b"\x10...\x1f" + b"auv-7".ljust(32, b"\0") + sha256(b"a mission\n"):
// hashlib.blake2b(b"EARSHOT ORDER2" + told + order, key=bytes(range(32)), digest_size=16)
TEST(CommandKey, MarksACommandForAChallengeAsPythonsBlake2bDoes) {
  EXPECT_EQ(key().mark_of(start(), challenge()),
            (CommandMark{0xcc, 0x0e, 0x4b, 0x6b, 0x92, 0xab, 0xb3, 0x35, 0x93, 0x02, 0x5f, 0xaf, 0xb0, 0xb9, 0xf9, 0x22}));
  EXPECT_EQ(key().mark_of(tighten(), challenge()),
            (CommandMark{0x5c, 0x7d, 0xc9, 0x71, 0x29, 0x5e, 0x51, 0xae, 0x86, 0xb1, 0xf7, 0xee, 0xde, 0xdf, 0x8d, 0xd6}));
}

// hashlib.blake2b(b"EARSHOT CHALLENGE1" + struct.pack("<q", time) + told, ...)
TEST(CommandKey, MarksAChallengeAsPythonsBlake2bDoes) {
  const CommandMark mark = CommandMark{0x1c, 0xf9, 0x3d, 0xf5, 0x22, 0xea, 0xbe, 0x66, 0x83, 0x00, 0x13, 0xaa, 0x3b, 0xf3, 0x3a, 0x80};
  EXPECT_EQ(key().mark_of(challenge(), start().time), mark);
  messages::PublishedChallenge published{.time = start().time, .challenge = challenge(), .mark = mark};
  EXPECT_TRUE(key().verifies(published));
  ++published.time.us;
  EXPECT_FALSE(key().verifies(published));
}

// hashlib.blake2b(order, ...): as it was before there was a challenge.
TEST(CommandKey, KnowsTheOldMarkOfACommandAlone) {
  const CommandMark mark{0x5e, 0x9e, 0xc9, 0xb8, 0x07, 0x50, 0x79, 0xa8, 0xb8, 0x67, 0x59, 0xdb, 0x93, 0xc1, 0x05, 0x3c};
  EXPECT_EQ(key().old_mark_of(start()), mark);
  EXPECT_EQ(key().old_mark_of(tighten()),
            (CommandMark{0xac, 0xf5, 0x7c, 0x48, 0x40, 0x46, 0x27, 0xaa, 0x06, 0x13, 0x63, 0xcf, 0x1b, 0x3b, 0x04, 0xea}));
  OperatorCommand command = start();
  command.mark = mark;
  EXPECT_TRUE(key().verifies_old(command));
  EXPECT_FALSE(key().verifies(command, {}));
  EXPECT_FALSE(key().verifies(command, challenge()));
}

TEST(CommandKey, VerifiesItsOwnMarkOnTheVeryCommandAlone) {
  OperatorCommand command = tighten();
  EXPECT_FALSE(key().verifies(command, challenge())) << "no mark";
  command.mark = key().mark_of(command, challenge());
  EXPECT_TRUE(key().verifies(command, challenge()));
  command.is_verified = true;
  EXPECT_TRUE(key().verifies(command, challenge())) << "what a port has found is not marked";
  const auto changed = [&command](auto change) {
    OperatorCommand other = command;
    change(other);
    return other;
  };
  for (const OperatorCommand& other :
       {changed([](auto& c) { ++c.time.us; }), changed([](auto& c) { ++c.expiry.us; }), changed([](auto& c) { ++c.issuer; }),
        changed([](auto& c) { ++c.number; }), changed([](auto& c) { c.order = Order::kStart; }),
        changed([](auto& c) { c.limits.max_depth.reset(); }), changed([](auto& c) { c.limits.max_speed.reset(); }),
        changed([](auto& c) { c.limits.max_time_s.reset(); }), changed([](auto& c) { c.mark[15] ^= 1U; })})
    EXPECT_FALSE(key().verifies(other, challenge()));
  KeyBytes another{};
  EXPECT_FALSE(CommandKey(another).verifies(command, challenge()));
}

TEST(CommandKey, VerifiesNoMarkThatWasMadeForAnotherStartVehicleOrMission) {
  OperatorCommand command = start();
  command.mark = key().mark_of(command, challenge());
  for (std::size_t byte = 0; byte < 80; ++byte) {
    messages::Challenge other = challenge();
    std::uint8_t* const part = byte < 16 ? &other.nonce[byte] : (byte < 48 ? &other.vehicle[byte - 16] : &other.mission[byte - 48]);
    *part ^= 1U;
    EXPECT_FALSE(key().verifies(command, other)) << byte;
  }
}

TEST(CommandKey, IsReadFromAFileOf64HexadecimalDigits) {
  const support::TemporaryFolder folder;
  support::write_secret_file(folder / "good.key", "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f\n");
  EXPECT_EQ(CommandKey(folder / "good.key").old_mark_of(start()), key().old_mark_of(start()));
  for (const char* const text : {"", "00", "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f20",
                                 "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f x", "no key"}) {
    support::write_secret_file(folder / "bad.key", text);
    try {
      (void)CommandKey(folder / "bad.key");
      ADD_FAILURE() << text;
    } catch (const BadInput& e) {
      EXPECT_TRUE(support::has_line(std::string(e.what()), {"bad.key", "hold", "64 hexadecimal"})) << e.what();
    }
  }
}

TEST(CommandKey, ThatOthersCanReadIsRefusedWithTheChmodThatMendsIt) {
  const support::TemporaryFolder folder;
  support::write_secret_file(folder / "vehicle.key", "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f\n");
  std::filesystem::permissions(folder / "vehicle.key", std::filesystem::perms::others_read, std::filesystem::perm_options::add);
  try {
    (void)CommandKey(folder / "vehicle.key");
    ADD_FAILURE() << "it is taken";
  } catch (const BadInput& e) {
    EXPECT_NE(std::string(e.what()).find("chmod 600 " + (folder / "vehicle.key").string()), std::string::npos) << e.what();
  }
}

TEST(CommandKey, OfAFileLeavesNoCoreDump) {
  const support::TemporaryFolder folder;
  support::write_secret_file(folder / "vehicle.key", std::string(64, '1'));
  ASSERT_EQ(::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0), 0);
  (void)CommandKey(folder / "vehicle.key");
  EXPECT_EQ(::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0), 0);
  (void)::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0);
}

}  // namespace
}  // namespace earshot::host
