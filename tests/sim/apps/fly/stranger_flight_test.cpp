// A flight on whose bus somebody else tells an SNR and a bearing: the programs themselves, over real LCM and real DDS.

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "earshot/bearing_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/scenario/flight.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

/// Answers every fix with a loud source in the north, dated as the fix and the two after it are: of what a tick brings the stranger's comes
/// first.
class Stranger {
 public:
  explicit Stranger(const std::string& url)
      : endpoint_(host::parse_lcm_url(url), {wire::kNavStateChannel}), thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) answer();
        }) {}

 private:
  void answer() {
    std::this_thread::sleep_for(100us);
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) {
      nav_state_t fix{};
      if (support::read_peer(message.data, fix) != Status::kOk) continue;
      for (std::int64_t ahead = 0; ahead < 3; ++ahead) {
        snr_estimate_t snr{};
        snr.utime = fix.utime + ahead * 1'000'000;
        snr.snr_db = 40.0;
        (void)endpoint_.publish(wire::kSnrEstimateChannel, support::bytes_of(snr));
        bearing_t bearing{};
        bearing.utime = snr.utime;
        bearing.deviation_rad = 0.1;
        (void)endpoint_.publish(wire::kBearingChannel, support::bytes_of(bearing));
      }
    }
  }

  host::LcmEndpoint endpoint_;
  std::jthread thread_;  // last: it uses the endpoint
};

class StrangerFlight : public Flight {
 protected:
  void SetUp() override {
    Flight::SetUp();
    shorten_to(5);
  }

  /// All that the flight was decided by. Port reports may count messages of a stranger who sent too many at once as lost.
  [[nodiscard]] std::vector<std::vector<std::uint8_t>> measurements_and_decisions(const char* out) const {
    std::vector<std::vector<std::uint8_t>> records;
    host::JournalReader reader(folder_ / out / "journal.lcmlog");
    for (host::JournalRecord record; reader.next(record);) {
      if (record.channel.starts_with(wire::kBearingChannel) || record.channel.starts_with(wire::kSnrEstimateChannel) ||
          record.channel == wire::kDecisionChannel)
        records.push_back(record.data);
    }
    return records;
  }

  void expect_undisturbed_in(const fs::path& environment) const {
    const auto alone = fly("alone", {"--seed", "7"}, environment);
    ASSERT_EQ(alone->wait(120s), 0) << alone->output();
    std::string url = slot_.lcm_url();  // that this process holds, but for the group
    url.replace(url.find("76.67"), 5, "76.68");
    const auto stranger = std::make_unique<Stranger>(url);
    const auto disturbed = fly("disturbed", {"--seed", "7", "--lcm-url", url, "--quiet"}, environment);
    ASSERT_EQ(disturbed->wait(120s), 0) << disturbed->output();
    EXPECT_TRUE(support::read_text(folder_ / "alone/track.csv") == support::read_text(folder_ / "disturbed/track.csv"));
    EXPECT_TRUE(measurements_and_decisions("alone") == measurements_and_decisions("disturbed"));
    EXPECT_TRUE(support::has_line(disturbed->output(), {"ignored", "simulation", "simulator"})) << disturbed->output();
  }
};

TEST_F(StrangerFlight, GivenAStrangerWhoTellsAnSnrAndABearingItIsTheSameFlightAndSaysThatTheyWereIgnored) {
  expect_undisturbed_in(kEnvironment);
}

TEST_F(StrangerFlight, GivenAnArrayAndAStrangerWhoTellsABearingFirstItIsTheSameFlightAndSaysThatTheyWereIgnored) {
  const fs::path array = folder_ / "array.toml";
  std::ofstream(array) << support::read_text(kEnvironment) << "\n[conditions]\nbearing_deg = 5.0\n";
  expect_undisturbed_in(array);
}

}  // namespace
}  // namespace earshot
