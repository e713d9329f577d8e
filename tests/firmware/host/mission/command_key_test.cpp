#include "firmware/host/mission/command_key.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/temporary_folder.hpp"

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

// Both by Python: hashlib.blake2b(struct.pack("<qqIIB3d", ...), key=bytes(range(32)), digest_size=16)
TEST(CommandKey, MarksACommandAsPythonsBlake2bDoes) {
  EXPECT_EQ(key().mark_of(start()),
            (CommandMark{0x5e, 0x9e, 0xc9, 0xb8, 0x07, 0x50, 0x79, 0xa8, 0xb8, 0x67, 0x59, 0xdb, 0x93, 0xc1, 0x05, 0x3c}));
  EXPECT_EQ(key().mark_of(tighten()),
            (CommandMark{0xac, 0xf5, 0x7c, 0x48, 0x40, 0x46, 0x27, 0xaa, 0x06, 0x13, 0x63, 0xcf, 0x1b, 0x3b, 0x04, 0xea}));
}

TEST(CommandKey, VerifiesItsOwnMarkOnTheVeryCommandAlone) {
  OperatorCommand command = tighten();
  EXPECT_FALSE(key().verifies(command)) << "no mark";
  command.mark = key().mark_of(command);
  EXPECT_TRUE(key().verifies(command));
  command.is_verified = true;
  EXPECT_TRUE(key().verifies(command)) << "what a port has found is not marked";
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
    EXPECT_FALSE(key().verifies(other));
  KeyBytes another{};
  EXPECT_FALSE(CommandKey(another).verifies(command));
}

TEST(CommandKey, IsReadFromAFileOf64HexadecimalDigits) {
  const support::TemporaryFolder folder;
  support::write_secret_file(folder / "good.key", "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f\n");
  EXPECT_EQ(CommandKey(folder / "good.key").mark_of(start()), key().mark_of(start()));
  for (const char* const text : {"", "00", "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f20",
                                 "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f x", "no key"}) {
    support::write_secret_file(folder / "bad.key", text);
    try {
      (void)CommandKey(folder / "bad.key");
      ADD_FAILURE() << text;
    } catch (const BadInput& e) {
      EXPECT_NE(std::string(e.what()).find("bad.key: must hold a command key of 64 hexadecimal digits"), std::string::npos) << e.what();
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

}  // namespace
}  // namespace earshot::host
