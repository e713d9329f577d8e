#include "tests/endurance/witness.hpp"

#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "firmware/wire/lcm/channels.hpp"

namespace earshot::endurance {
namespace {

constexpr std::uint64_t kBetweenNonsense = 997;  ///< turns

bool went_back(const messages::PortReport& before, const messages::PortReport& after) {
  return after.received < before.received || after.lost < before.lost || after.malformed < before.malformed || after.unsent < before.unsent;
}

bool went_back(const messages::Health& before, const messages::Health& after) {
  const messages::Counters& b = before.counters;
  const messages::Counters& a = after.counters;
  if (a.navigation_refused < b.navigation_refused || a.snr_refused < b.snr_refused || a.commands_refused < b.commands_refused ||
      a.setpoints_limited < b.setpoints_limited || after.steps_taken < before.steps_taken || after.ports.size() < before.ports.size())
    return true;
  for (std::size_t i = 0; i < before.ports.size(); ++i) {
    if (went_back(before.ports[i], after.ports[i])) return true;
  }
  return false;
}

}  // namespace

Witness::Witness(std::uint8_t index, const std::string& lcm_url, Duration period, Plant plant)
    : Port(index, {}),
      bus_(host::parse_lcm_url(lcm_url), {wire::kHealthChannel}),
      turns_an_hour_(static_cast<std::uint64_t>(3'600'000'000 / period.us)),
      plant_(plant) {}

void Witness::collect(board::Clock& /*clock*/, board::InputSink& /*sink*/) {
  listen();
}

void Witness::listen() {
  bus_.collect();
  for (wire::Lc02Message message; bus_.take(message) == Status::kOk;) ++seen_.heard;
}

std::uint64_t Witness::publish(Time /*now*/, const runtime::Outputs& outputs) {
  ++seen_.turns;
  if (outputs.setpoint) ++seen_.setpoints;
  if (outputs.decision) {
    if (outputs.decision->step != seen_.decisions) ++seen_.misnumbered;
    ++seen_.decisions;
  }
  seen_.acknowledgements += outputs.acknowledgements.size();
  if (went_back(seen_.last, outputs.health)) ++seen_.went_back;
  seen_.last = outputs.health;
  listen();
  if (seen_.turns % kBetweenNonsense == 0) {
    constexpr std::array<std::uint8_t, 5> kNonsense{1, 2, 3, 4, 5};
    if (bus_.publish(wire::kNavStateChannel, kNonsense) == Status::kOk) ++seen_.nonsense_sent;
  }
  if (seen_.turns == turns_an_hour_) seen_.first_hour = host::process_memory();
  if (seen_.turns > turns_an_hour_ && seen_.turns % turns_an_hour_ == 0) do_planted();
  return 0;
}

void Witness::do_planted() {
  if (plant_ == Plant::kAllocation) {
    void* const volatile taken = std::aligned_alloc(64, 64);  // volatile: the compiler may leave out what nobody looks at
    std::free(taken);
  }
  if (plant_ == Plant::kWrap) report_.lost = 4'294'967'295U - report_.lost;
  if (plant_ == Plant::kPage) {  // behind the back of everybody who counts calls
    const long page = ::syscall(SYS_mmap, nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (page > 0) *reinterpret_cast<volatile char*>(page) = 1;
  }
}

}  // namespace earshot::endurance
