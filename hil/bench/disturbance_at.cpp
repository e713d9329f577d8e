#include "hil/bench/disturbance_at.hpp"

#include <numbers>

namespace earshot::hil {

Disturbance disturbance_at(const std::vector<TimedFault>& faults, Time now, Duration tick) {
  Disturbance d;
  for (const TimedFault& fault : faults) {
    if (fault.traits().hits != FaultTarget::kVehicle || !fault.acts_at(now)) continue;
    switch (fault.fault) {
      case Fault::kRudderStuck:
        d.is_rudder_stuck = true;
        break;
      case Fault::kPlanesStuck:
        d.are_planes_stuck = true;
        break;
      case Fault::kNoThrust:
        d.has_no_thrust = true;
        break;
      case Fault::kDisengaged:
        d.is_disengaged = true;
        break;
      case Fault::kObstinate:
        d.is_obstinate = true;
        break;
      case Fault::kSteerageWay:
        d.steerage_way = MetersPerSecond{fault.amount};
        break;
      case Fault::kCurrent:
        d.current_mps = d.current_mps + fault.vector();
        break;
      case Fault::kBattery:
        if (fault.is_new_at(now, tick)) d.battery_percent = fault.amount;
        break;
      case Fault::kLeak:
        d.hull.wet = true;
        break;
      case Fault::kGroundFault:
        d.hull.has_ground_fault = true;
        break;
      case Fault::kFloorRise:
        d.floor_rise += Meters{fault.amount};
        break;
      case Fault::kFrozen:
        d.is_frozen = true;
        break;
      case Fault::kPositionError:
        d.position_error = d.position_error + fault.vector();
        break;
      case Fault::kHeadingError:
        d.heading_error = d.heading_error + Radians{fault.amount * std::numbers::pi / 180.0};
        break;
      case Fault::kDepthError:
        d.depth_error += Meters{fault.amount};
        break;
      case Fault::kSpeedError:
        d.speed_error += MetersPerSecond{fault.amount};
        break;
      case Fault::kPositionDrift: {
        const double seconds = (now - fault.from).to_seconds();
        d.position_error = d.position_error + NorthEast{fault.vector().north * seconds, fault.vector().east * seconds};
        break;
      }
      case Fault::kPositionShiver:
        d.is_place_stuck = true;
        // From side to side, once a second.
        d.position_error = d.position_error + NorthEast{Meters{now.us / 1'000'000 % 2 == 0 ? fault.amount : -fault.amount}, Meters{}};
        break;
      case Fault::kDepthDrift:
        d.depth_error += Meters{fault.amount * (now - fault.from).to_seconds()};
        break;
      case Fault::kDepthStuck:
        d.stuck_depth = Meters{fault.amount};
        break;
      case Fault::kDeaf:
        d.hydrophone.is_deaf = true;
        break;
      case Fault::kGainError:
        d.hydrophone.gain_error += Decibels{fault.amount};
        break;
      default:
        throw NoMaker(fault.fault, "of the vehicle");
    }
  }
  return d;
}

}  // namespace earshot::hil
