// GIVEN a vehicle whose mission names a key, WHEN orders for it are recorded, cut or meant for another, THEN only its own are obeyed.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
using messages::CommandOutcome;

const std::string kExamples = EARSHOT_SOURCE_DIR "/firmware/boards/linux/examples/";

class MarkedOrders : public WalkAtSea {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    bus_.emplace(host::parse_lcm_url(host::kDefaultLcmUrl),
                 std::vector{wire::kOperatorCommandChannel, wire::kAcknowledgementChannel, wire::kNavStateChannel});
    support::write_secret_file(folder_ / "vehicle.key", std::string(62, '0') + "2a\n");
    write_mission(mission_of_short_steps("search.toml") + "\n[authority]\nkey_file = \"vehicle.key\"\nvehicle_id = \"auv-7\"\n");
    begin();
  }
  void begin() {
    start_earshotd({});
    ASSERT_TRUE(comes_true([this] { return earshotd_->output().find(" STANDBY") != std::string::npos; })) << earshotd_->output();
  }
  void end() {
    earshotd_->signal(SIGTERM);
    EXPECT_GE(earshotd_->wait(20s), 0);
    std::filesystem::remove(folder_ / "earshotd.txt");  // what it said
  }

  [[nodiscard]] bool comes_true(const std::function<bool()>& is_true) {
    for (const auto deadline = std::chrono::steady_clock::now() + 30s; std::chrono::steady_clock::now() < deadline;) {
      if (is_true()) return true;
      std::this_thread::sleep_for(20ms);
      bus_->collect();
      for (wire::Lc02Message message; bus_->take(message) == Status::kOk;) note(message);
    }
    return false;
  }
  void note(const wire::Lc02Message& message) {
    if (message.channel == wire::kNavStateChannel) ++fixes_;
    if (message.channel == wire::kOperatorCommandChannel) ++orders_;
    if (message.channel == wire::kOperatorCommandChannel) recorded_.assign(message.data.begin(), message.data.end());
    command_acknowledgement_t answer{};
    if (message.channel == wire::kAcknowledgementChannel && support::read_peer(message.data, answer) == Status::kOk)
      answers_.push_back(static_cast<CommandOutcome>(answer.outcome));
  }

  /// Python's program says so much of an order.
  void expect_output(const std::vector<std::string>& words, const std::string& said, int status) {
    const char* const interpreter = std::getenv("EARSHOT_PYTHON");
    std::vector<std::string> a{kExamples + "order_over_lcm.py", std::string(host::kDefaultLcmUrl)};
    a.insert(a.end(), words.begin(), words.end());
    support::Process python(interpreter == nullptr ? "" : interpreter, a, folder_ / "order.txt");
    int ended = -1;
    EXPECT_TRUE(comes_true([&] { return (ended = python.wait(1ms)) >= 0; }));
    EXPECT_EQ(python.output(), said);
    EXPECT_EQ(ended, status);
  }
  /// A program in Python that sends one message, given as an expression of its bytes.
  void send_by_python(const std::string& program) {
    const char* const interpreter = std::getenv("EARSHOT_PYTHON");
    const std::string head = "import lcm, time; from earshot import operator_command_t; o = operator_command_t(); ";
    const std::string tail = "; lcm.LCM('" + std::string(host::kDefaultLcmUrl) + "').publish('EARSHOT_OPERATOR_COMMAND', o.encode())";
    support::Process python(interpreter == nullptr ? "" : interpreter, {"-c", head + program + tail}, folder_ / "sent.txt");
    EXPECT_EQ(python.wait(20s), 0) << python.output();
  }

  std::optional<host::LcmEndpoint> bus_;
  std::vector<std::uint8_t> recorded_;  ///< the order that was on the bus last
  std::vector<CommandOutcome> answers_;
  int fixes_ = 0;
  int orders_ = 0;
};

TEST_F(MarkedOrders, AreMadeForTheVehicleThatIsMeantAndItsMissionAlone) {
  const std::string key = folder_ / "vehicle.key";
  const std::string heard = " was heard within 10 s (heard: \"auv-7\"; is --vehicle-id, --mission or --key-file another's?)\n";
  expect_output({"START", "--key-file", key, "--vehicle-id", "auv-8"}, "START: no vehicle named \"auv-8\" with this key" + heard, 1);
  expect_output({"START", "--key-file", key}, "START: no vehicle without a name (--vehicle-id) with this key" + heard, 1);
  expect_output({"START", "--key-file", key, "--vehicle-id", "auv-7", "--mission", key},
                "START: no vehicle named \"auv-7\" with this key and mission" + heard, 1);
  EXPECT_TRUE(recorded_.empty()) << "nothing was sent that somebody could record";
  expect_output({"START", "--key-file", key, "--vehicle-id", "auv-7", "--mission", folder_ / "mission.toml"}, "START: OBEYED\n", 0);
  end();
}

// A port keeps few orders between two turns: of somebody who sends ten a second most would be counted as lost.
TEST_F(MarkedOrders, AreSentOnceASecondAndNotWithEveryFixWhileNobodyAnswers) {
  end();
  const char* const interpreter = std::getenv("EARSHOT_PYTHON");
  support::Process vehicle(interpreter == nullptr ? "" : interpreter,
                           {kExamples + "autopilot_over_lcm.py", std::string(host::kDefaultLcmUrl)}, folder_ / "vehicle.txt");
  EXPECT_TRUE(comes_true([this] { return fixes_ >= 40; })) << vehicle.output();
  vehicle.signal(SIGINT);
  (void)vehicle.wait(10s);
  EXPECT_GE(orders_, 1);
  EXPECT_LE(orders_, fixes_ / 4) << "ten fixes a second";
}

TEST_F(MarkedOrders, AreNotObeyedAgainOnceTheVehicleHasBegunAnew) {
  expect_output({"START", "--key-file", folder_ / "vehicle.key", "--vehicle-id", "auv-7"}, "START: OBEYED\n", 0);
  ASSERT_FALSE(recorded_.empty());
  const std::vector<std::uint8_t> start = recorded_;
  end();
  begin();  // within the 30 s in which its date would be right
  answers_.clear();
  ASSERT_EQ(bus_->publish(wire::kOperatorCommandChannel, start), Status::kOk);
  ASSERT_TRUE(comes_true([this] { return !answers_.empty(); })) << earshotd_->output();
  EXPECT_EQ(answers_.front(), CommandOutcome::kNotVerified);
  EXPECT_TRUE(comes_true([this] {
    return earshotd_->output().find("an order was refused: its mark is missing or wrong") != std::string::npos;
  })) << earshotd_->output();
  end();
}

TEST_F(MarkedOrders, ToAbortAreObeyedThoughPythonLeftTheirMarkOut) {
  send_by_python("o.command = operator_command_t.START; o.mark = b''");
  ASSERT_TRUE(comes_true([this] { return answers_.size() == 1; })) << earshotd_->output();
  EXPECT_EQ(answers_[0], CommandOutcome::kUnreadable);
  send_by_python("o.command = operator_command_t.ABORT; o.mark = b''");
  ASSERT_TRUE(comes_true([this] { return answers_.size() == 2; })) << earshotd_->output();
  EXPECT_EQ(answers_[1], CommandOutcome::kObeyed);
  EXPECT_TRUE(support::has_line(earshotd_->output(), {"ABORT", "obeyed whose", "not"})) << earshotd_->output();
  EXPECT_TRUE(support::has_line(earshotd_->output(), {"order", "not", "read", "not obeyed"})) << earshotd_->output();
  end();
}

}  // namespace
}  // namespace earshot
