#pragma once

#include "firmware/config/mission.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/runtime/outputs.hpp"
#include "firmware/runtime/progress.hpp"
#include "firmware/runtime/search_agent.hpp"

namespace earshot::runtime {

/// One turn of a search: from what was heard on a leg to the next one. Owns nothing: made where a turn is made.
class Search {
 public:
  Search(const config::Mission& mission, SearchAgent& agent, Progress& progress) : mission_(mission), agent_(agent), progress_(progress) {}

  /// kCorrupt: the agent's memory was found damaged, and no search has begun.
  /// @pre progress.may_begin_search()
  [[nodiscard]] Status begin(Time now);
  /// kCorrupt: the agent's memory was found damaged, and nothing was done with it.
  /// @pre a search is under way
  [[nodiscard]] Status turn(Time now, Outputs& outputs);

 private:
  /// On a leg: what the belief makes of all that was heard until the next decision, a slice a turn.
  [[nodiscard]] Status refine();
  [[nodiscard]] Status end_leg(Time now, Outputs& outputs);
  [[nodiscard]] bool decide(Time now, const policy::Reception& reception, messages::Decision& decision);

  const config::Mission& mission_;
  SearchAgent& agent_;
  Progress& progress_;
};

}  // namespace earshot::runtime
