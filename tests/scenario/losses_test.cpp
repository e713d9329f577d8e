// Flights that lose something on the way: one of their halves, the disk, their operator.

#include "tests/scenario/flight.hpp"

#include <csignal>

#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

class Losses : public Flight {};

TEST_F(Losses, GivenItsRuntimeIsKilledTheSimulatorSaysSoWithinFiveSecondsAndKeepsTheTrack) {
  start_both();
  ASSERT_TRUE(is_under_way()) << runtime_->output() << simulator_->output();
  runtime_->signal(SIGKILL);
  EXPECT_EQ(simulator_->wait(5s), 3);
  EXPECT_NE(simulator_->output().find("lost earshotd"), std::string::npos) << simulator_->output();
  EXPECT_EQ(nlohmann::json::parse(support::read_text(folder_ / "summary.json")).at("end_reason"), "earshotd_lost");
  EXPECT_GT(support::read_text(folder_ / "track.csv").size(), 1000);
  // What the killed process had handed to the kernel is there; at most its last record is cut.
  EXPECT_GT(journal().records, 100);
  EXPECT_NE(journal().end, host::JournalReader::End::kCorrupt);
}

TEST_F(Losses, GivenItsSimulatorIsKilledTheRuntimeSaysSoWithinFiveSecondsAndItsJournalIsWhole) {
  start_both();
  ASSERT_TRUE(is_under_way()) << runtime_->output() << simulator_->output();
  simulator_->signal(SIGKILL);
  EXPECT_EQ(runtime_->wait(5s), 3);
  EXPECT_NE(runtime_->output().find("lost the simulator"), std::string::npos) << runtime_->output();
  EXPECT_GT(journal().records, 100);
  EXPECT_EQ(journal().end, host::JournalReader::End::kWhole);
  EXPECT_FALSE(fs::exists(folder_ / "summary.json"));
}

TEST_F(Losses, GivenAFullDiskTheFlightIsLostWithStatusThreeAndEveryRowThatWasWrittenIsKept) {
  const std::string domain = std::to_string(slot_.domain());
  std::vector<std::string> a = policy_arguments();
  a.insert(a.end(), {kMission, "--out", folder_.path(), "--simulation", domain, "--lcm-url", slot_.lcm_url()});
  runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / "earshotd.txt");
  // A limit on the size of one file stands for the disk: room for snr.csv (some 60 kB) and for some 2000 of 50 000 rows of the track.
  simulator_ = std::make_unique<support::Process>(
      "/bin/bash",
      std::vector<std::string>{"-c", "ulimit -f 200; exec \"$@\"", "bash", kBin / "earshot-sim", "--environment", kEnvironment, "--mission",
                               kMission, "--out", folder_.path(), "--domain", domain, "--lcm-url", slot_.lcm_url(), "--ignore-source"},
      folder_ / "earshot-sim.txt");
  EXPECT_EQ(simulator_->wait(60s), 3) << simulator_->output();
  EXPECT_NE(simulator_->output().find("track.csv"), std::string::npos) << simulator_->output();
  EXPECT_EQ(runtime_->wait(10s), 3) << runtime_->output();
  const nlohmann::json s = nlohmann::json::parse(support::read_text(folder_ / "summary.json"));
  EXPECT_EQ(s.at("end_reason"), "simulator_failed");
  EXPECT_FALSE(fs::exists(folder_ / "track.csv.partial"));
  const std::string track = support::read_text(folder_ / "track.csv");
  EXPECT_GT(track.size(), 200'000);
  EXPECT_EQ(track.back(), '\n');
}

TEST_F(Losses, GivenADiskThatIsFullBeforeTheFirstTickTheFlightIsLostWithStatusThreeAndNotRefused) {
  // Room for some 8 kB of a file stands for it: snr.csv takes 60.
  std::vector<std::string> a{"-c",
                             "trap '' XFSZ; ulimit -f 8; exec \"$@\"",
                             "bash",
                             kBin / "earshot-fly",
                             "--environment",
                             kEnvironment,
                             "--mission",
                             kMission,
                             "--out",
                             folder_ / "out",
                             "--no-report"};
  for (const std::string& word : policy_arguments()) a.push_back(word);
  support::Process flight("/bin/bash", a, folder_ / "text");
  EXPECT_EQ(flight.wait(60s), 3) << flight.output();
  EXPECT_NE(flight.output().find("snr.csv"), std::string::npos) << flight.output();
}

TEST_F(Losses, GivenAFullDiskUnderItsJournalEarshotdFliesOnAndCountsEveryRecordThatIsNotInTheFile) {
  const auto fly_with_room_for = [this](const std::string& name, const std::string& kibibytes) {
    const std::string domain = std::to_string(slot_.domain());
    std::vector<std::string> a{"-c", "trap '' XFSZ; ulimit -f " + kibibytes + "; exec \"$@\"", "bash", kBin / "earshotd"};
    for (const std::string& word : policy_arguments()) a.push_back(word);
    a.insert(a.end(), {kMission, "--out", folder_ / name, "--simulation", domain, "--lcm-url", slot_.lcm_url()});
    runtime_ = std::make_unique<support::Process>("/bin/bash", a, folder_ / (name + ".txt"));
    simulator_ = std::make_unique<support::Process>(
        kBin / "earshot-sim",
        std::vector<std::string>{"--environment", kEnvironment, "--mission", kMission, "--out", folder_ / (name + "-sim"), "--domain",
                                 domain, "--lcm-url", slot_.lcm_url(), "--ignore-source"},
        folder_ / "earshot-sim.txt");
    EXPECT_EQ(simulator_->wait(120s), 0) << simulator_->output();
    return runtime_->wait(20s);
  };
  const auto records_of = [this](const std::string& name) {
    host::JournalReader reader(folder_ / name / "journal.lcmlog");
    std::size_t records = 0;
    for (host::JournalRecord record; reader.next(record);) ++records;
    EXPECT_EQ(reader.end(), host::JournalReader::End::kWhole) << name;
    return records;
  };
  ASSERT_EQ(fly_with_room_for("whole", "unlimited"), 0) << runtime_->output();
  ASSERT_EQ(fly_with_room_for("full", "1000"), 3) << runtime_->output();
  EXPECT_TRUE(support::read_text(folder_ / "whole-sim/track.csv") == support::read_text(folder_ / "full-sim/track.csv"));
  const std::size_t lost = records_of("whole") - records_of("full") + 1;  // one more was made, which says that the disk is full
  EXPECT_GT(lost, 10'000);
  EXPECT_TRUE(support::has_line(runtime_->output(), {"journal", "disk", "not take"})) << runtime_->output();
  EXPECT_NE(runtime_->output().find("the journal is not whole: " + std::to_string(lost) + " records lost: "), std::string::npos)
      << lost << " " << runtime_->output();
}

TEST_F(Losses, GivenCtrlCBothEndInOrderAndTheJournalIsWhole) {
  const auto flight = fly("out", {"--speed", "500", "--ignore-source"});
  ASSERT_TRUE(is_under_way("out")) << flight->output();
  flight->signal(SIGINT);
  EXPECT_EQ(flight->wait(5s), 130) << flight->output();
  EXPECT_EQ(summary("out").at("end_reason"), "interrupted");
  EXPECT_NE(flight->output().find(": interrupted\n"), std::string::npos) << flight->output();
  EXPECT_EQ(journal("out").end, host::JournalReader::End::kWhole);
}

TEST_F(Losses, GivenItDiedAtSeaItStartsAgainBesideTheJournalThatIsThere) {
  // earshotd holds the lock on its address itself, and the slot's is taken: a port that goes with the slot and is none.
  const std::string url = "udpm://239.255.76.67:" + std::to_string(20'000 + slot_.domain()) + "?ttl=0";
  const auto start_at_sea = [this, &url](const char* text) {
    std::vector<std::string> a = policy_arguments();
    a.insert(a.end(), {kMission, "--out", folder_.path(), "--lcm-url", url});
    runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / text);
  };
  const auto wait_for_records = [this](const char* name) {
    std::error_code error;
    for (int i = 0; i < 1000 && !(fs::exists(folder_ / name) && fs::file_size(folder_ / name, error) > 0); ++i)
      std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(fs::exists(folder_ / name)) << runtime_->output();
  };
  start_at_sea("first.txt");
  wait_for_records("journal.lcmlog");
  runtime_->signal(SIGKILL);
  (void)runtime_->wait(5s);
  start_at_sea("second.txt");
  wait_for_records("journal-2.lcmlog");
  runtime_->signal(SIGTERM);
  EXPECT_EQ(runtime_->wait(5s), 0);
  EXPECT_NE(runtime_->output().find("journal-2.lcmlog"), std::string::npos) << runtime_->output();
  EXPECT_GT(journal().records, 0);
}

}  // namespace
}  // namespace earshot
