#include "policy/command_line/policy_details.hpp"

#include <ostream>
#include <sstream>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/talk.hpp"

namespace earshot::command_line {

void print_policy_details(const std::string& name, const policy::FrozenPolicy& policy) {
  std::ostream& out = program::detail();
  out << host::printable(name) << ": " << policy.observation.spec.size() << " elements of observation, " << policy.actions.size()
      << " actions, steps of " << policy.step_length.value << " m in " << policy.area_size.north.value << " m x "
      << policy.area_size.east.value << " m\n";
  std::istringstream provenance(std::string(policy.provenance.begin(), policy.provenance.end()));
  for (std::string line; std::getline(provenance, line);) out << "  " << host::printable(line) << "\n";
}

}  // namespace earshot::command_line
