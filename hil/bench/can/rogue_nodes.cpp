#include "hil/bench/can/rogue_nodes.hpp"

#include <algorithm>
#include <utility>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "hil/nodes/autopilot.hpp"
#include "hil/nodes/instruments.hpp"
#include "hil/nodes/membership.hpp"

namespace earshot::hil {
namespace {

/// The highest unique numbers are theirs: the vehicle's devices count from a low one.
constexpr std::uint32_t kFirstNumber = 0x1FFF80U;
constexpr std::uint8_t kStrangersAddress = 0x7A;
constexpr std::uint32_t kStrangersNumber = 0xBAD;

/// A device that does nothing but claim the address that Earshot has.
class AddressThief final : public Device {
 public:
  explicit AddressThief(std::uint32_t unique_number)
      : membership_({.model = "address thief",
                     .device_class = 10,  // system tools: lower than any device of a vehicle, which gives it more rights
                     .device_function = 130,
                     .preferred_address = n2k::kRuntimeAddress,
                     .unique_number = unique_number},
                    {}, {}) {}
  [[nodiscard]] std::string_view name() const override { return membership_.model(); }
  [[nodiscard]] std::optional<std::uint8_t> address() const override { return membership_.address(); }
  void accept(const n2k::Frame& frame, Time now) override { membership_.accept(frame, now); }
  void step(Time now, Frames& frames) override { membership_.step(now, frames); }

 private:
  Membership membership_;
};

/// One that has no helm, and says so.
std::unique_ptr<Device> make_idle_autopilot(const vehicle::State& vehicle, std::uint32_t unique_number) {
  auto autopilot = std::make_unique<Autopilot>(vehicle::Command{.heading = vehicle.heading, .speed = vehicle.speed, .depth = vehicle.depth},
                                               unique_number);
  autopilot->engage(false);
  return autopilot;
}

}  // namespace

RogueNodes::RogueNodes(const std::vector<TimedFault>& faults, const vehicle::State& vehicle, const n2k::LocalPlane& plane)
    : vehicle_(vehicle) {
  std::uint32_t number = kFirstNumber;
  for (const TimedFault& fault : faults) {
    if (fault.traits().hits != FaultTarget::kBus || fault.fault == Fault::kInterfaceDown) continue;
    RogueNode rogue_node{.fault = fault};
    switch (fault.fault) {
      case Fault::kSecondNavigation:
        rogue_node.believed = std::make_unique<vehicle::State>(vehicle);
        rogue_node.device = make_navigation(*rogue_node.believed, plane, number++);
        break;
      case Fault::kSecondAutopilot:
        rogue_node.device = make_idle_autopilot(vehicle, number++);
        break;
      case Fault::kAddressThief:
        rogue_node.device = std::make_unique<AddressThief>(number++);
        break;
      case Fault::kFlood:
      case Fault::kStrangersOrder:
        break;
      default:
        throw NoMaker(fault.fault, "of who is on a CAN bus");
    }
    rogue_nodes_.push_back(std::move(rogue_node));
  }
}

void RogueNodes::accept(const n2k::Frame& frame, Time now) {
  for (const RogueNode& rogue_node : rogue_nodes_) {
    if (rogue_node.device && rogue_node.fault.acts_at(now)) rogue_node.device->accept(frame, now);
  }
}

void RogueNodes::step(Time now, Frames& frames) {
  const double passed_s = (now - std::exchange(last_, now).value_or(now)).to_seconds();
  for (RogueNode& rogue_node : rogue_nodes_) {
    if (!rogue_node.fault.acts_at(now)) continue;
    if (rogue_node.believed) {
      *rogue_node.believed = vehicle_;
      rogue_node.believed->position = vehicle_.position + rogue_node.fault.vector();
    }
    if (rogue_node.device) rogue_node.device->step(now, frames);
    if (rogue_node.fault.fault == Fault::kFlood) flood(rogue_node.fault.amount * passed_s, frames);
    if (rogue_node.fault.fault == Fault::kStrangersOrder && rogue_node.pace.is_due(now)) give_old_order(now, frames);
  }
}

bool RogueNodes::fill_bus(Time now) const {
  double frames_per_s = 0.0;
  for (const RogueNode& rogue_node : rogue_nodes_) {
    if (rogue_node.fault.fault == Fault::kFlood && rogue_node.fault.acts_at(now)) frames_per_s += rogue_node.fault.amount;
  }
  return frames_per_s >= kFullBus_frames_per_s;
}

void RogueNodes::flood(double new_frames, Frames& frames) {
  owed_frames_ += new_frames;
  for (; owed_frames_ >= 1.0; owed_frames_ -= 1.0) {
    n2k::Frame frame{.identifier = kFloodIdentifier};
    for (unsigned i = 0; i < 4; ++i) frame.data.at(i) = static_cast<std::uint8_t>(flooded_ >> (8U * i));
    ++flooded_;
    frames.push_back(frame);
  }
}

void RogueNodes::give_old_order(Time now, Frames& frames) {
  const Time long_ago = std::max(Time{}, Time{now.us - Duration::seconds(20).us});
  n2k::FastPacketFrames packet;
  const messages::OperatorCommand order{.time = long_ago,
                                        .expiry = long_ago + Duration::seconds(1),
                                        .issuer = kStrangersNumber,
                                        .number = static_cast<std::uint32_t>(orders_) + 1,
                                        .order = messages::Order::kComplete};
  const n2k::Route route{.source = kStrangersAddress, .destination = n2k::kRuntimeAddress, .sequence = orders_++};
  if (n2k::compose_command(order, route, packet) == Status::kOk) frames.insert(frames.end(), packet.begin(), packet.end());
}

}  // namespace earshot::hil
