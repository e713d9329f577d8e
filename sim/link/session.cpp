#include "sim/link/session.hpp"

#include <dds/dds.h>

namespace earshot::link {

std::string cyclone_configuration() {
  return R"(<CycloneDDS><Domain Id="any">
<General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces><AllowMulticast>false</AllowMulticast></General>
<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address="127.0.0.1"/></Peers><LeaseDuration>)" +
         std::to_string(kLeaseSeconds) + R"( s</LeaseDuration><SPDPInterval>100 ms</SPDPInterval></Discovery>
</Domain></CycloneDDS>)";
}

Session::Session(std::uint32_t domain) {
  domain_ = dds_create_domain(domain, cyclone_configuration().c_str());
  if (domain_ < 0) throw LinkError("simulation link: DDS domain " + std::to_string(domain) + ": " + dds_strretcode(domain_));
  participant_ = dds_create_participant(domain, nullptr, nullptr);
  if (participant_ < 0) {
    dds_delete(domain_);
    throw LinkError("simulation link: DDS participant in domain " + std::to_string(domain) + ": " + dds_strretcode(participant_));
  }
}

Session::~Session() {
  dds_delete(domain_);
}

}  // namespace earshot::link
