#pragma once

#include <cstdint>
#include <optional>

#include "firmware/config/mission.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/safety/situation.hpp"

namespace earshot::safety {

/// What the vehicle does in place of its search while a rule acts.
class Manoeuvre {
 public:
  /// @param response  not kWarn
  /// @pre the situation has a fix
  [[nodiscard]] messages::Setpoint setpoint(const config::Mission& mission, const Situation& situation, config::Response response);

  /// The search goes on: the next manoeuvre begins anew.
  void end() { *this = Manoeuvre{}; }

 private:
  enum class Side : std::int8_t { kNone = 0, kRight = 1, kLeft = -1 };

  [[nodiscard]] messages::Setpoint steer_back(const config::Mission& mission, const Situation& situation);
  [[nodiscard]] messages::Setpoint stay_at(const config::Mission& mission, const Situation& situation, NorthEast place) const;
  [[nodiscard]] messages::Setpoint hold(const config::Mission& mission, const Situation& situation);
  [[nodiscard]] static messages::Setpoint come_up_from(const config::Mission& mission, const Situation& situation);
  [[nodiscard]] static messages::Setpoint surface(const config::Mission& mission, const Situation& situation);
  [[nodiscard]] static Side open_side(const config::Mission& mission, const messages::Navigation& fix, Radians error);
  [[nodiscard]] Radians by_way_of_its_side(const config::Mission& mission, const messages::Navigation& fix, Radians wanted);

  Side side_ = Side::kNone;           ///< of a turn back by more than a right angle, until it is over
  std::optional<NorthEast> holding_;  ///< the place
};

}  // namespace earshot::safety
