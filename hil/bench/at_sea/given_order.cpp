#include "hil/bench/at_sea/given_order.hpp"

#include <stdexcept>

#include "firmware/host/transport/can_socket.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "hil/nodes/operator.hpp"

namespace earshot::hil {
namespace {

constexpr std::uint8_t kAddress = 0x7A;
constexpr std::uint32_t kIssuer = 0x5EA;  // one process gives few orders, and none twice

}  // namespace

void give_order(const std::string& interface, messages::Order order, Time utc) {
  const messages::OperatorCommand command{
      .time = utc, .expiry = utc + kOrderLife, .issuer = kIssuer, .number = static_cast<std::uint32_t>(order), .order = order};
  n2k::FastPacketFrames frames;
  host::CanSocket socket(interface);
  bool is_sent = n2k::compose_command(command, {.source = kAddress, .destination = n2k::kRuntimeAddress}, frames) == Status::kOk;
  for (const n2k::Frame& frame : frames) is_sent = is_sent && socket.send(frame) == Status::kOk;
  if (!is_sent) throw std::runtime_error("the bus takes no order");
}

}  // namespace earshot::hil
