// What the page is given is held against the page's own types: TypeScript's compiler reads both.

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>

#include "policy/report/document/flight_reading.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCompiler = "/usr/bin/tsc";

class FlightTypes : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kCompiler)) GTEST_SKIP() << kCompiler << " is not installed (Debian: node-typescript)";
  }
  /// What the compiler complains of in a program that says that `json` is of a type; "": nothing.
  [[nodiscard]] std::string complaints_about(const std::string& type, const std::string& json) const {
    fs::copy_file(fs::path(EARSHOT_SOURCE_DIR) / "policy/report/page/source/flight.ts", folder_ / "flight.ts",
                  fs::copy_options::overwrite_existing);
    std::ofstream(folder_ / "made.ts") << "import { " << type << " } from \"./flight\";\nexport const made: " << type << " = " << json
                                       << ";\n";
    support::Process compiler(kCompiler, {"--strict", "--noEmit", "--target", "es2020", folder_ / "made.ts"}, folder_ / "complaints");
    const int status = compiler.wait(std::chrono::seconds(60));
    EXPECT_EQ(status == 0, compiler.output().empty()) << compiler.output();
    return compiler.output();
  }

  const support::TemporaryFolder folder_;
};

TEST_F(FlightTypes, AreThoseOfASimulatedFlightWithItsTruth) {
  const auto policy = explain::belief_policy(1);
  const messages::Bearing bearing{.direction = Radians{1.0}, .deviation = Radians{0.1}, .mirror_axis = Radians{2.0}};
  write_flight(folder_ / "flight", *policy, explain::flown(*policy, 3, {}, bearing), {});
  EXPECT_EQ(complaints_about("Flight", read_to_its_end(surroundings_of(folder_ / "flight"))->whole().dump()), "");
}

TEST_F(FlightTypes, AreThoseOfAFlightAtSeaAndOfWhatComesOfOneUnderWay) {
  {
    SeaJournal journal(folder_ / kJournalName);
    journal.order(1, messages::Order::kStart);
    journal.port(2, {.port = 1, .link_up = false});
    journal.fix(3, 3'000, 4'000);
    journal.snr(4, 12.0, true);
    journal.battery(5, 80.0);
    journal.state(10, messages::MissionState::kSearch, messages::EndReason::kNone, 0);
    messages::Decision declaring;
    declaring.found.emplace();
    journal.decision(90, declaring);
    journal.end(messages::Ending::kStopped);
  }
  const auto flight = read_to_its_end(surroundings_of(folder_ / kJournalName));
  EXPECT_EQ(complaints_about("Flight", flight->whole().dump()), "");
  Sent nothing;
  EXPECT_EQ(complaints_about("FlightNews", flight->changes(nothing).dump()), "");
}

TEST_F(FlightTypes, AreNotThoseOfAFlightThatLacksAPart) {
  nlohmann::ordered_json flight = GrowingFlight({.name = "a", .journal = {}, .files = {}, .recording = {}}).whole();
  EXPECT_EQ(complaints_about("Flight", flight.dump()), "");
  flight.erase("truth");
  EXPECT_NE(complaints_about("Flight", flight.dump()).find("truth"), std::string::npos);
}

}  // namespace
}  // namespace earshot::report
