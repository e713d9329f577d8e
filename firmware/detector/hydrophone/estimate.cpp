#include "firmware/detector/hydrophone/estimate.hpp"

namespace earshot::detector {

const char* to_string(Hearing hearing) {
  switch (hearing) {
    case Hearing::kHears:
      return "hears";
    case Hearing::kFloorUnsettled:
      return "does not know the noise yet";
    case Hearing::kFillingUp:
      return "has just begun";
    case Hearing::kFlowNoise:
      return "flow noise";
    case Hearing::kSelfNoise:
      return "the vehicle's own noise";
    case Hearing::kClipped:
      return "clipped";
    case Hearing::kGainChanged:
      return "the gain changed";
    case Hearing::kDropout:
      return "samples are missing";
    case Hearing::kOpen:
      return "nothing but the ADC's own noise: open or dead hydrophone";
    case Hearing::kStuck:
      return "every sample alike: shorted hydrophone or stuck ADC";
    case Hearing::kSaturated:
      return "saturated";
    case Hearing::kNotANumber:
      return "samples that are no numbers, or far beyond full scale";
    case Hearing::kImpossible:
      return "no such sound can be heard: calibration, sample rate or block are impossible";
  }
  return "?";
}

std::optional<bool> is_deaf(Hearing hearing) {
  switch (hearing) {
    case Hearing::kFillingUp:
    case Hearing::kGainChanged:
    case Hearing::kDropout:
      return std::nullopt;
    case Hearing::kHears:
    case Hearing::kFloorUnsettled:
    case Hearing::kFlowNoise:
    case Hearing::kSelfNoise:
    case Hearing::kClipped:
      return false;
    case Hearing::kOpen:
    case Hearing::kStuck:
    case Hearing::kSaturated:
    case Hearing::kNotANumber:
    case Hearing::kImpossible:
      return true;
  }
  return std::nullopt;
}

}  // namespace earshot::detector
