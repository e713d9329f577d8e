#include "policy/description/draw.hpp"

namespace earshot::description {

std::string_view name_of(policy::ActionDraw draw) {
  return draw == policy::ActionDraw::kArgmax ? kDraws[0] : kDraws[1];
}

std::optional<policy::ActionDraw> draw_named(std::string_view name) {
  if (name == kDraws[0]) return policy::ActionDraw::kArgmax;
  if (name == kDraws[1]) return policy::ActionDraw::kSampled;
  return std::nullopt;
}

}  // namespace earshot::description
