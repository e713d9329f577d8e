// The vehicle's program with all of NMEA 2000 that a CAN port needs, code and state: linked to know its size (check_budgets), run by
// nobody.

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/node/node.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/sensors/source_gate.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "firmware/wire/n2k/vehicle_state/vehicle_condition.hpp"

namespace {

using namespace earshot;

/// What a CAN port holds of them (firmware/boards/linux/can/can_port.hpp): fixes, the vehicle's condition, whose SNR and autopilot it goes
/// by, orders, and the device that it is on the bus itself.
struct CanPort {
  CanPort(const n2k::LocalPlane& plane, const n2k::NavigationSettings& navigation, const n2k::Identity& identity,
          const n2k::SourceChoice& snr_source, const n2k::SourceChoice& autopilot_source, std::span<const std::uint32_t> sent,
          std::span<const std::uint32_t> read)
      : receiver(plane, navigation),
        condition(navigation.oldest_part),
        snr_gate(snr_source),
        autopilot_gate(autopilot_source),
        node(identity, sent, read) {}

  n2k::NavigationReceiver receiver;
  n2k::VehicleCondition condition;
  n2k::SourceGate snr_gate;
  n2k::SourceGate autopilot_gate;
  n2k::OrderReceiver orders;
  n2k::Node node;
};
alignas(CanPort) std::array<std::byte, sizeof(CanPort)> port;

/// The linker must keep what a function is taken of.
template <class Function>
void keep(Function function) {
  asm volatile("" : : "m"(function) : "memory");
}

}  // namespace

extern "C" __attribute__((used)) void keep_can(const n2k::LocalPlane& plane, const n2k::NavigationSettings& navigation,
                                               const n2k::NameParts& name, const n2k::SourceChoice& source,
                                               std::span<const std::uint32_t> groups) {
  const n2k::Identity identity{.name = n2k::name_of(name).value(), .preferred_address = 64, .product = {}, .configuration = {}};
  const auto* made = new (port.data()) CanPort(plane, navigation, identity, source, source, groups, groups);
  asm volatile("" : : "r"(made) : "memory");
  keep(&n2k::Node::accept);
  keep(&n2k::Node::step);
  keep(static_cast<Status (n2k::NavigationReceiver::*)(const n2k::HeardFrame&, Time, messages::Navigation&)>(
      &n2k::NavigationReceiver::accept));
  keep(&n2k::NavigationReceiver::zero_at_surface);
  keep(&n2k::OrderReceiver::accept);
  keep(&n2k::VehicleCondition::accept_hull);
  keep(&n2k::VehicleCondition::give);
  keep(&n2k::parse_identifier);
  keep(&n2k::SourceGate::status_of);
  keep(&n2k::SourceGate::hold);
  keep(&n2k::read_snr);
  keep(&n2k::measurement_of);
  keep(&n2k::read_deaf);
  keep(&n2k::read_autopilot_status);
  keep(&n2k::compose_setpoint);
  keep(&n2k::compose_acknowledgement);
  keep(&n2k::compose_decision);
  keep(&n2k::compose_health);
  keep(&n2k::compose_port_health);
}
