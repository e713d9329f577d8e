#include "policy/command_line/policy_details.hpp"

#include <cstddef>
#include <ostream>
#include <sstream>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/talk.hpp"

namespace earshot::command_line {

std::string network_text(const policy::Network& network) {
  if (!policy::has_network(network)) return "no network";
  std::string sizes;
  for (std::size_t l = 0; l < network.hidden_count(); ++l) sizes += (l == 0 ? "" : "-") + std::to_string(network.hidden_sizes[l]);
  return "network " + sizes + (network.activation == policy::Activation::kRelu ? " ReLU" : " tanh") + " of " +
         std::to_string(policy::bytes_of_numbers(network)) + " bytes";
}

void print_policy_details(const std::string& name, const policy::FrozenPolicy& policy) {
  std::ostream& out = program::detail();
  out << host::printable(name) << ": " << policy.observation.spec.size() << " elements of observation, " << policy.actions.size()
      << " actions, " << network_text(policy.network) << ", steps of " << policy.step_length.value << " m in "
      << policy.area_size.north.value << " m x " << policy.area_size.east.value << " m\n";
  std::istringstream provenance(std::string(policy.provenance.begin(), policy.provenance.end()));
  for (std::string line; std::getline(provenance, line);) out << "  " << host::printable(line) << "\n";
}

}  // namespace earshot::command_line
