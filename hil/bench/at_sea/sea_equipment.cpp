#include "hil/bench/at_sea/sea_equipment.hpp"

#include <unistd.h>

#include <algorithm>

namespace earshot::hil {
namespace {

using State = n2k::ControllerState;

constexpr Decibels kSourceSnr{15.0};  ///< over the mission's threshold, wherever the vehicle is

/// Two benches on one host do not hear each other.
std::string own_sound_url() {
  return "udpm://239.255.76.70:" + std::to_string(10'000 + ::getpid() % 20'000) + "?ttl=0";
}

SoundFault sound_of(const TimedFault& fault) {
  switch (fault.fault) {
    case Fault::kSoundDropout:
      return {.line = SoundLine::kWhole, .gain_error = {}, .is_mute = true};
    case Fault::kSoundGain:
      return {.line = SoundLine::kWhole, .gain_error = Decibels{fault.amount}};
    case Fault::kSoundOpen:
      return {.line = SoundLine::kOpen};
    case Fault::kSoundShorted:
      return {.line = SoundLine::kShorted};
    default:
      throw NoMaker(fault.fault, "of a hydrophone's samples");
  }
}

}  // namespace

SeaEquipment::SeaEquipment(const Case& c, const Bench& bench) : case_(c), bus_(bench.interface), sound_url_(own_sound_url()) {
  if (c.has(FaultTarget::kController)) {
    try {
      adapter_.emplace(bus_);
    } catch (const NoSerialCan& e) {
      throw NotFlown(e.what());
    }
  }
  if (c.has(Fault::kNetem) && !(set_netem(bus_, "delay 1us") && set_netem(bus_, "")))
    throw NotFlown("the kernel has no netem, or we are not root, or there is no tc");
  if (c.sound_port != 0) hydrophone_.emplace(sound_url_, *c.speed, kSourceSnr, bench.seed);
}

SeaEquipment::~SeaEquipment() {
  if (has_netem_) (void)set_netem(bus_, "");
}

std::vector<std::string> SeaEquipment::options_of_earshotd() const {
  std::vector<std::string> options{"--can-interface", adapter_ ? adapter_->interface() : bus_};
  if (hydrophone_) options.insert(options.end(), {"--hydrophone-url", sound_url_});
  return options;
}

void SeaEquipment::begin(const TimedFault& fault) {
  switch (fault.fault) {
    case Fault::kErrorPassive:
      return adapter_->become(State::kErrorPassive);
    case Fault::kBusOff:
      return adapter_->become(State::kBusOff);
    case Fault::kNetem:
      has_netem_ = set_netem(bus_, fault.how);
      return;
    default:
      if (fault.traits().hits != FaultTarget::kSound) throw NoMaker(fault.fault, "at sea");
      hydrophone_->disturb(sound_of(fault));
  }
}

void SeaEquipment::end(const TimedFault& fault) {
  switch (fault.fault) {
    case Fault::kErrorPassive:
    case Fault::kBusOff:
      return adapter_->become(State::kErrorActive);
    case Fault::kNetem:
      netem_ = netem_now();
      if (set_netem(bus_, "")) has_netem_ = false;
      return;
    default:
      if (fault.traits().hits != FaultTarget::kSound) throw NoMaker(fault.fault, "at sea");
      hydrophone_->disturb({});
  }
}

NetemCounts SeaEquipment::netem_now() const {
  const NetemCounts more = has_netem_ ? netem_counts(bus_).value_or(NetemCounts{}) : NetemCounts{};
  return {.passed = netem_.passed + more.passed, .dropped = netem_.dropped + more.dropped};
}

std::vector<std::string> SeaEquipment::uncounted() const {
  std::vector<std::string> all;
  const auto require = [&all](bool is_counted, const char* what) {
    if (!is_counted) all.push_back(std::string("the kernel has counted no ") + what);
  };
  const ControllerCounts controller = adapter_ ? controller_counts(adapter_->interface()).value_or(ControllerCounts{}) : ControllerCounts{};
  if (case_.has(Fault::kErrorPassive)) require(controller.error_passive > 0, "controller that became error-passive");
  if (case_.has(Fault::kBusOff)) require(controller.bus_off > 0, "controller that left the bus");
  for (const TimedFault& fault : case_.faults) {
    if (fault.fault != Fault::kNetem) continue;
    const bool loses = fault.how.find("loss") != std::string::npos;
    require((loses ? netem_now().dropped : netem_now().passed) > 0, loses ? "frame that netem dropped" : "frame that netem passed");
  }
  return all;
}

}  // namespace earshot::hil
