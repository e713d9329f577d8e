#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/bearing_measurement.hpp"

namespace earshot::policy {

/// How likely a bearing is, were the source at one place or another, over how likely it would be if it said nothing: one everywhere then.
///
///   L = (1 - o) 2 pi W(a - d; s) + o,   s^2 = deviation^2 + (cell / r)^2 / 12, s at most pi
///
/// W is the normal distribution wrapped round the circle, a the direction of the place from the vehicle, r its range, d the bearing, o the
/// share of bearings that follow no model. Where left and right cannot be told apart W is the mean of those about d and about its mirror
/// image. A place stands for a cell, all of whose directions are smeared into one: beside the vehicle a bearing says nothing.
/// Its bits depend on no machine, and not on the compiler either.
/// Oracle: BearingLikelihood.*
class BearingLikelihood {
 public:
  /// @param bearing        messages::is_possible()
  /// @param cell           side of the cells, >= 0
  /// @param outlier_share  o, 0 to 1
  BearingLikelihood(const messages::Bearing& bearing, Meters cell, float outlier_share);

  /// @param way  from the vehicle to the place
  [[nodiscard]] float at(NorthEast way) const;

 private:
  double direction_;
  double mirrored_;  ///< the same where there is no mirror image
  double variance_;
  double smear_;  ///< (cell)^2 / 12, m^2
  double regular_;
  double outlier_;
};

}  // namespace earshot::policy
