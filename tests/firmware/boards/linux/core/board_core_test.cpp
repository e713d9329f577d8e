#include "firmware/boards/linux/core/board_core.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "firmware/boards/cortex_m7/flight_board.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/policy/envelope/envelope.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/cortex_m7/fake_machine.hpp"
#include "tests/firmware/policy/format/unsigned_file.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using std::chrono::milliseconds;

/// The microcontroller's own application at the other end of a socket, in a thread of its own.
class BoardInAThread {
 public:
  explicit BoardInAThread(const std::filesystem::path& path) {
    machine::fake() = {};
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    const bool listens = ::bind(listening_.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
                         ::listen(listening_.number(), 1) == 0;
    if (!listens) throw std::runtime_error("no socket " + path.string());
    thread_ = std::thread([this] { run(); });
  }
  BoardInAThread(const BoardInAThread&) = delete;
  BoardInAThread& operator=(const BoardInAThread&) = delete;
  ~BoardInAThread() {
    stop = true;
    thread_.join();
  }

  std::atomic<bool> stop{false};
  std::atomic<bool> is_silent{false};      ///< takes what comes and says nothing
  std::atomic<bool> begins_anew{false};    ///< instead of the next answer
  std::atomic<std::size_t> lose_bytes{0};  ///< the next so many that come

 private:
  void run() {
    pollfd waiting{.fd = listening_.number(), .events = POLLIN, .revents = 0};
    while (!stop && ::poll(&waiting, 1, 10) == 0) {
    }
    if (stop) return;
    const host::FileDescriptor line(::accept(listening_.number(), nullptr, nullptr));
    auto board = std::make_unique<FlightBoard>();
    std::vector<std::uint8_t> bytes(300);
    while (!stop) {
      pollfd reading{.fd = line.number(), .events = POLLIN, .revents = 0};
      if (::poll(&reading, 1, 10) == 0) continue;
      const ssize_t count = ::read(line.number(), bytes.data(), bytes.size());
      if (count <= 0) return;
      std::span<const std::uint8_t> came = std::span(bytes).first(static_cast<std::size_t>(count));
      const std::size_t lost = std::min(came.size(), lose_bytes.load());
      lose_bytes -= lost;
      if (begins_anew.exchange(false)) {
        board = std::make_unique<FlightBoard>();
        board->begin();
        came = {};
      }
      board->take(came.subspan(std::min(lost, came.size())));
      std::vector<std::uint8_t>& sent = machine::fake().sent;
      if (!is_silent && !sent.empty()) (void)::send(line.number(), sent.data(), sent.size(), MSG_NOSIGNAL);
      sent.clear();
    }
  }

  host::FileDescriptor listening_{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  std::thread thread_;
};

class BoardCoreTest : public testing::Test {
 protected:
  std::unique_ptr<BoardCore> connect(milliseconds patience = milliseconds(5000)) {
    return std::make_unique<BoardCore>(host::SerialLine(path_), mission_, policy_, tables_, patience);
  }
  std::string refusal(milliseconds patience = milliseconds(5000)) {
    try {
      (void)connect(patience);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "";
  }

  support::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "line";
  config::Mission mission_ = runtime::paper_mission();
  std::vector<std::uint8_t> policy_ = policy::unsigned_file(*runtime::frozen(*runtime::policy_that_believes()));
  std::vector<std::uint8_t> tables_ = policy::unsigned_file(*runtime::paper_oceans());
  BoardInAThread board_{path_};
};

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message, Time sent = {}) {
  const wire::Encoded encoded(message, sent);
  return {encoded.bytes().begin(), encoded.bytes().end()};
}

TEST_F(BoardCoreTest, GivesTheSetPointsDecisionsAndHealthOfARuntimeInThisProcess) {
  const auto core = connect();
  runtime::Runtime own;
  ASSERT_EQ(own.configure(mission_, policy_, tables_), Status::kOk);
  int decisions = 0;
  std::size_t acknowledgements = 0;
  std::uint64_t inputs = 0;
  for (int second = 1; second <= 600; ++second) {
    const Time now{1'000'000'000 + Duration::seconds(second).us};
    const auto give = [&](const auto& value) {
      const messages::Input input{.arrival = now, .port = 2, .sequence = inputs++, .value = value};
      own.take(input);
      core->take(input);
    };
    give(messages::Navigation{.time = now,
                              .position = {Meters{7000.0 + 2.0 * second}, Meters{12000}},
                              .depth = Meters{0},
                              .heading = Radians{0},
                              .speed = MetersPerSecond{2}});
    give(messages::SnrMeasurement{.time = now, .snr = Decibels{12}});
    if (second == 2) give(runtime::command_of(messages::Order::kStart, now));
    const runtime::Outputs expected = own.step(now);
    const runtime::Outputs outputs = core->step(now);
    ASSERT_EQ(outputs.setpoint.has_value(), expected.setpoint.has_value());
    if (expected.setpoint) {
      ASSERT_EQ(bytes_of(*outputs.setpoint, now), bytes_of(*expected.setpoint, now));
    }
    ASSERT_EQ(outputs.decision.has_value(), expected.decision.has_value());
    if (expected.decision) {
      ASSERT_EQ(bytes_of(*outputs.decision), bytes_of(*expected.decision));
    }
    ASSERT_EQ(bytes_of(outputs.health, now), bytes_of(expected.health, now));
    ASSERT_EQ(outputs.acknowledgements.size(), expected.acknowledgements.size());
    for (std::size_t i = 0; i < expected.acknowledgements.size(); ++i) ASSERT_EQ(outputs.acknowledgements[i], expected.acknowledgements[i]);
    decisions += outputs.decision ? 1 : 0;
    acknowledgements += outputs.acknowledgements.size();
  }
  EXPECT_EQ(decisions, 2);
  EXPECT_EQ(acknowledgements, 1U);
  EXPECT_NE(core->remark().find("it used 100 of 1000 bytes of stack"), std::string::npos) << core->remark();
}

TEST_F(BoardCoreTest, SaysWhyTheBoardRefusesAMission) {
  mission_.step_length = Meters{500};
  EXPECT_TRUE(support::has_line(refusal(), {"refuses", "mission", "mission", "not"})) << refusal();
}

TEST_F(BoardCoreTest, SaysTheSizeOfAPolicyWhoseNetworkTheBoardDoesNotHold) {
  const std::size_t first_layer = 28;                   // 16 of header, 10 of the section, its form, its inputs
  policy_[first_layer] = policy_[first_layer + 1] = 1;  // 257 units
  const std::size_t checksum = policy_.size() - policy::kSignatureSize - 4;
  const std::uint32_t crc = crc32(std::span(policy_).first(checksum));
  for (unsigned i = 0; i < 4; ++i) policy_[checksum + i] = static_cast<std::uint8_t>(crc >> (8U * i));
  EXPECT_TRUE(support::has_line(refusal(), {"refuses", "capacities", "small", std::to_string(policy_.size()) + " bytes"})) << refusal();
}

TEST_F(BoardCoreTest, SaysThatNoBoardAnswers) {
  board_.is_silent = true;
  EXPECT_NE(refusal(milliseconds(5)).find("line: no board answers"), std::string::npos);
}

TEST_F(BoardCoreTest, RefusesAMissionOfWhosePolicyALineLosesAByte) {
  board_.lose_bytes = 1;
  EXPECT_NE(refusal().find("a piece of it was lost on the line"), std::string::npos);
}

std::string trouble_of(BoardCore& core) {
  try {
    (void)core.step(Time{1'000'000'000});
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST_F(BoardCoreTest, FliesOnWithNoBoardThatFallsSilent) {
  const auto core = connect(milliseconds(300));
  board_.is_silent = true;
  EXPECT_EQ(trouble_of(*core), "the board does not answer");
}

TEST_F(BoardCoreTest, FliesOnWithNoBoardThatBeginsAnew) {
  const auto core = connect();
  board_.begins_anew = true;
  EXPECT_TRUE(support::tells(trouble_of(*core), {"board", "begun", "no mission"}));
}

TEST_F(BoardCoreTest, FliesOnWithNoBoardThatMissesAnInput) {
  const auto core = connect();
  board_.lose_bytes = 1;
  core->take({.arrival = Time{1'000'000'000}, .port = 1, .sequence = 0, .value = messages::SnrMeasurement{}});
  EXPECT_TRUE(support::tells(trouble_of(*core), {"inputs", "lost", "board"}));
}

}  // namespace
}  // namespace earshot::board
