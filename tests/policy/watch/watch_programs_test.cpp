// GIVEN earshot watch, WHEN it is started, asked and stopped as people do it, THEN it serves the flight, or says what is wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/policy/apps/programs.hpp"
#include "tests/policy/watch/http/client.hpp"
#include "tests/support/secret_file.hpp"

namespace earshot::watch {
namespace {

using namespace std::chrono_literals;
using policy_programs::content;
namespace fs = std::filesystem;

class WatchProgram : public policy_programs::Programs {
 protected:
  /// What a program has printed, once there is a text in it, and an end of the line behind that.
  [[nodiscard]] std::string printed_with(const std::string& text) const {
    for (int i = 0; i < 400; ++i, std::this_thread::sleep_for(50ms)) {
      std::string printed = content(folder / "out");
      const std::size_t at = printed.find(text);
      if (at != std::string::npos && printed.find('\n', at) != std::string::npos) return printed;
    }
    ADD_FAILURE() << "nothing with " << text << ": " << content(folder / "out") << content(folder / "err");
    return text + "0\n";
  }
  /// The address that a program has printed on a line of its own.
  [[nodiscard]] std::uint16_t printed_port() const {
    const std::string before = "http://127.0.0.1:";
    const std::string printed = printed_with(before);
    return static_cast<std::uint16_t>(std::stoi(printed.substr(printed.find(before) + before.size())));
  }
  static std::unique_ptr<Client> browser(std::uint16_t port) {
    auto client = std::make_unique<Client>(port);
    client->send(request("GET /events"));
    return client;
  }
  const fs::path journal_ = folder / "journal.lcmlog";
};

TEST_F(WatchProgram, ServesAFlightUntilCtrlCAndSaysThatItIsOver) {
  journal::write_known_journal(journal_);
  for (const int number : {SIGINT, SIGTERM}) {
    support::Process process = start("watch " + journal_.string() + " --port 0");
    const std::uint16_t port = printed_port();
    EXPECT_EQ(std::ranges::count(content(folder / "out"), '\n'), 1) << content(folder / "out");
    const std::string page = answer(port, request("GET /"));
    EXPECT_NE(page.find("Content-Security-Policy: default-src 'none'; script-src 'sha256-"), std::string::npos);
    EXPECT_NE(page.find("</html>"), std::string::npos);
    const auto client = browser(port);
    EXPECT_NE(client->read_until("\"is_over\":true").find("event: flight\n"), std::string::npos);
    process.signal(number);
    EXPECT_EQ(process.wait(10s), 0) << content(folder / "err");
    client->read_all();
    EXPECT_TRUE(client->is_closed());
    fs::remove(folder / "out");
  }
}

TEST_F(WatchProgram, ShowsAJournalAsItGrowsAndAgainAfterAReload) {
  journal::WrittenJournal journal(journal_);
  journal.message(journal::kBegan, wire::kMissionChannel, journal::known_mission());
  journal.flush();
  support::Process process = start("watch " + folder.path().string() + " --port 0");
  const std::uint16_t port = printed_port();
  auto client = browser(port);
  EXPECT_NE(client->read_until("\"is_over\":false").find("event: flight\n"), std::string::npos);
  client->read_until("\n\n");
  journal.health(journal::after(7000), 1, messages::MissionState::kSearch);
  journal.flush();
  EXPECT_NE(client->read_until("\"time_s\":[7]", 5s).find("event: news\n"), std::string::npos);
  client = browser(port);
  EXPECT_NE(client->read_until("\"time_s\":[7]", 5s).find("event: flight\n"), std::string::npos);
  process.signal(SIGINT);
  EXPECT_EQ(process.wait(10s), 0);
}

TEST_F(WatchProgram, RefusesWhatItCannotShow) {
  refuses("watch nowhere", {"nowhere", "no such file", "--wait"});
  refuses("watch nowhere --wait 0", {"nowhere", "no mission began"});
  std::ofstream(folder / "text.lcmlog") << "no journal";
  refuses("watch text.lcmlog", {"text.lcmlog", "no record"});
  refuses("watch lcm --lcm-url tcp://here", {"--lcm-url tcp://here", "udpm://"});
  journal::write_known_journal(journal_);
  refuses("watch journal.lcmlog --port 65536", {"--port"});
}

TEST_F(WatchProgram, LetsOthersReadWithAPasswordAlone) {
  journal::write_known_journal(journal_);
  refuses("watch journal.lcmlog --listen 0.0.0.0", {"--listen", "--password-file"});
  support::write_secret_file(folder / "password", "correct horse\n");
  refuses("watch journal.lcmlog --listen localhost --password-file password", {"--listen localhost", "address"});
  refuses("watch journal.lcmlog --listen 203.0.113.1 --password-file password", {"203.0.113.1"});
  fs::permissions(folder / "password", fs::perms::group_read, fs::perm_options::add);
  refuses("watch journal.lcmlog --listen 0.0.0.0 --password-file password", {"password", "chmod 600"});
  fs::permissions(folder / "password", fs::perms::group_read, fs::perm_options::remove);
  support::Process process = start("watch journal.lcmlog --listen 0.0.0.0 --password-file password --port 0");
  const std::uint16_t port = printed_port();
  EXPECT_EQ(status_of(answer(port, request("GET /events"))), 401);
  EXPECT_EQ(status_of(answer(port, request("GET /", "Authorization: Basic dXNlcjpjb3JyZWN0IGhvcnNl\r\n"))), 200);  // user:correct horse
  EXPECT_EQ(content(folder / "err").find("correct"), std::string::npos);
}

TEST_F(WatchProgram, SharesItsPortWithNobody) {
  journal::write_known_journal(journal_);
  support::Process first = start("watch journal.lcmlog --port 0");
  const std::string port = std::to_string(printed_port());
  support::Process second(EARSHOT_BIN_DIR "/earshot-watch", {journal_.string(), "--port", port},
                          {.folder = folder, .output = folder / "out 2", .errors = folder / "err 2"});
  EXPECT_EQ(second.wait(10s), 2);
  EXPECT_NE(content(folder / "err 2").find("port " + port), std::string::npos) << content(folder / "err 2");
}

TEST_F(WatchProgram, ShowsAFlightOfEarshotFlyThatStaysUntilCtrlC) {
  const std::string search = "fly --out flight --seed 3 --no-report --watch";
  support::Process process = start(search);
  const auto client = browser(printed_port());
  // Once its files are in their place, the page has what only the simulator knew.
  const std::string events = client->read_until("\"truth\":{", 120s);
  EXPECT_NE(events.find("event: flight\n"), std::string::npos);
  EXPECT_NE(events.find("\"is_over\":true"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "flight/summary.json"));
  (void)printed_with("page        stays at the address above until Ctrl-C");  // behind what the page was sent
  process.signal(SIGINT);
  EXPECT_EQ(process.wait(20s), 0) << content(folder / "err");
  client->read_all();
  EXPECT_TRUE(client->is_closed());
}

}  // namespace
}  // namespace earshot::watch
