// watch.decision_ms: from a decision in the journal to the event of it at a browser, at 95 % of the decisions of a search of 100 steps,
// each with the belief and the reasons that its policy gives. Twenty browsers look on, one of which never reads. The journal is written
// again as a flight wrote it, a decision every 60 to 100 ms.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/bench/short_form.hpp"
#include "tests/policy/watch/http/client.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace earshot;
using namespace std::chrono_literals;
using std::chrono::steady_clock;
namespace fs = std::filesystem;

fs::path program(const char* name) {
  return fs::path(EARSHOT_BIN_DIR) / name;
}

/// A search that goes on to its last step.
void fly(const fs::path& folder, const fs::path& words) {
  support::Process flight(program("earshot-fly"), {"--seed", "1", "--ignore-source", "--no-report", "--out", folder.string()}, words);
  if (const int status = flight.wait(5min); status != 0)
    throw std::runtime_error(flight.output() + "earshot-fly: status " + std::to_string(status));
}

/// The address on the first line that earshot watch prints.
std::uint16_t port_of(const support::Process& process) {
  for (int i = 0; i < 200; ++i, std::this_thread::sleep_for(50ms))
    if (process.output().find('\n') != std::string::npos) return watch::port_in(process.output());
  throw std::runtime_error("earshot-watch: no address");
}

std::unique_ptr<watch::Client> browser_at(std::uint16_t port) {
  auto client = std::make_unique<watch::Client>(port);
  client->send(watch::request("GET /events"));
  if (client->read_until("event: flight").empty()) throw std::runtime_error("earshot-watch: no events");
  return client;
}

/// Browsers that read what comes.
class Readers {
 public:
  Readers(std::uint16_t port, int count) {
    for (int i = 0; i < count; ++i)
      threads_.emplace_back([client = browser_at(port)](const std::stop_token& stop) {
        while (!stop.stop_requested()) client->read_until("\n\n", 50ms);
      });
  }

 private:
  std::vector<std::jthread> threads_;
};

/// Writes a flight's journal again, and measures how long its decisions take to a browser, ms.
class Measurement {
 public:
  Measurement(const fs::path& flown, const fs::path& written, watch::Client& browser, std::size_t most)
      : reader_(flown), journal_(written, {.existing = host::ExistingJournal::kReplace}), browser_(browser), most_(most) {}

  [[nodiscard]] std::vector<double> run() {
    std::vector<double> times_ms;
    while (times_ms.size() < most_ && copy_turn()) {
      if (!has_decision_) continue;
      times_ms.push_back(milliseconds_to_event(decisions_));
      ++decisions_;
      std::this_thread::sleep_for(60ms + 1ms * (decisions_ * 17 % 40));  // at no fixed phase of who looks for it
    }
    return times_ms;
  }

 private:
  /// The records up to a turn's last. @return false at the journal's end
  bool copy_turn() {
    has_decision_ = false;
    for (host::JournalRecord record; reader_.next(record);) {
      if (bench::is_wrong_on_purpose() && record.channel == wire::kPolicyChannel) continue;  // then nothing explains them
      if (journal_.append(record.time, record.channel, record.data, host::Priority::kOrder) != Status::kOk)
        throw std::runtime_error("not written");
      has_decision_ = has_decision_ || record.channel == wire::kDecisionChannel;
      if (record.channel == wire::kHealthChannel) return journal_.flush() == Status::kOk;
    }
    return false;
  }

  double milliseconds_to_event(std::size_t step) {
    const auto began = steady_clock::now();
    const std::string before = browser_.read_until("\"decisions\":[{\"step\":" + std::to_string(step) + ",", 5s);
    const std::string event = browser_.read_until("\n\n", 5s);
    const auto took = steady_clock::now() - began;
    if (!event.ends_with("\n\n")) throw std::runtime_error("no event of decision " + std::to_string(step));
    if (event.find("\"area_of_cell\"") == std::string::npos) throw std::runtime_error("a decision without its belief");
    return std::chrono::duration<double, std::milli>(took).count();
  }

  host::JournalReader reader_;
  host::Journal journal_;
  watch::Client& browser_;
  std::size_t most_;
  std::size_t decisions_ = 0;
  bool has_decision_ = false;
};

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

int main() try {
  constexpr int kReaders = 18;
  const support::TemporaryFolder folder;
  fly(folder / "flight", folder / "words.txt");
  const fs::path written = folder / "journal.lcmlog";
  support::Process server(program("earshot-watch"), {written.string(), "--wait", "60", "--port", "0"}, folder / "watch.txt");
  const std::uint16_t port = port_of(server);
  const std::unique_ptr<watch::Client> measured = browser_at(port);
  const std::unique_ptr<watch::Client> stuck = browser_at(port);
  const Readers others(port, kReaders);
  Measurement measurement(folder / "flight/journal.lcmlog", written, *measured, bench::full_or_short<std::size_t>(100, 3));
  std::vector<double> times_ms = measurement.run();
  if (times_ms.empty()) throw std::runtime_error("no decision came");
  std::ranges::sort(times_ms);
  std::cout << nlohmann::ordered_json{{"name", "watch.decision_ms"},  {"unit", "ms"},
                                      {"decisions", times_ms.size()}, {"p50", quantile(times_ms, 0.5)},
                                      {"most", times_ms.back()},      {"value", quantile(times_ms, 0.95)}}
            << "\n";
  return 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
