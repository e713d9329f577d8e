#include "hil/nodes/membership.hpp"

#include <stdexcept>
#include <utility>

#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::hil {
namespace {

std::vector<std::uint32_t> with(std::vector<std::uint32_t> own, std::initializer_list<std::uint32_t> everybodys) {
  own.insert(own.end(), everybodys);
  return own;
}

n2k::Identity identity_of(const Nameplate& plate) {
  const Result<n2k::Name> name =
      n2k::name_of({.unique_number = plate.unique_number, .device_function = plate.device_function, .device_class = plate.device_class});
  if (!name.ok()) throw std::invalid_argument("a device's unique number has 21 bits");
  return {.name = name.value(),
          .preferred_address = plate.preferred_address,
          .product = {.model = plate.model, .software_version = "emulated", .model_version = "", .serial = ""},
          .configuration = {}};
}

}  // namespace

Membership::Membership(const Nameplate& plate, std::vector<std::uint32_t> sends, std::vector<std::uint32_t> reads)
    : model_(plate.model),
      sends_(with(std::move(sends), {n2k::kAcknowledgementPgn, n2k::kRequestPgn, n2k::kAddressClaimPgn, n2k::kPgnListPgn,
                                     n2k::kHeartbeatPgn, n2k::kProductPgn, n2k::kConfigurationPgn})),
      reads_(with(std::move(reads), {n2k::kRequestPgn, n2k::kAddressClaimPgn, n2k::kCommandedAddressPgn})),
      node_(identity_of(plate), sends_, reads_) {}

void Membership::step(Time now, Frames& frames) {
  n2k::NodeFrames own;
  node_.step(now, own);
  frames.insert(frames.end(), own.begin(), own.end());
}

}  // namespace earshot::hil
