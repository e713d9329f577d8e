// LCM's datagrams, whole and in fragments, in the reassembly of a vehicle's bus.
//
// The input is a row of datagrams, each: what it is (1 byte; bit 0: a fragment, bit 1: noise without a magic, bits 2 and 3: its sender),
// how many bytes (2), the bytes. LCM's magic is laid over the first four by exclusive or: zeros there are LCM's.

#include <memory>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/lcm/lc02.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"

namespace earshot::fuzz {
namespace {

std::vector<std::uint8_t> datagram_in(Input& input, std::uint8_t what) {
  const std::span<const std::uint8_t> bytes = input.bytes(input.word());
  std::vector<std::uint8_t> datagram(bytes.begin(), bytes.end());
  const std::uint32_t magic = (what & 1U) != 0U ? wire::kFragmentMagic : wire::kShortMagic;
  for (std::size_t i = 0; i < 4 && i < datagram.size() && (what & 2U) == 0U; ++i)
    datagram[i] ^= static_cast<std::uint8_t>(magic >> (24U - 8U * i));
  return datagram;
}

void require_sound(const wire::Lc02Message& message) {
  require(message.channel.size() <= wire::kMaxChannelLength, "a channel is longer than LCM allows");
  require(message.channel.find('\0') == std::string_view::npos, "a channel holds a zero");
  require(message.data.size() <= config::kLcmMessageBytes, "a message is larger than there is room for");
  unsigned sum = 0;
  for (const std::uint8_t byte : message.data) sum += byte;  // a sanitizer sees whether they may be read
  volatile unsigned seen = sum;
  (void)seen;
}

/// Each datagram counts once, in one counter or in none (a fragment that is kept, or one more of a message that is not whole).
void require_counted(const wire::ReceiveCounters& before, const wire::ReceiveCounters& after, Status status) {
  require(after.completed - before.completed == (status == Status::kOk ? 1U : 0U), "a message that was handed out was not counted");
  require(after.malformed - before.malformed == (status == Status::kMalformed ? 1U : 0U), "a malformed datagram was not counted");
  require(after.too_large - before.too_large == (status == Status::kFull ? 1U : 0U), "a message too large was not counted");
}

}  // namespace

void judge(std::span<const std::uint8_t> bytes) {
  static const auto reassembly = std::make_unique<wire::Reassembly>();
  *reassembly = {};
  for (Input input(bytes); !input.is_used_up();) {
    const std::uint8_t what = input.byte();
    const std::vector<std::uint8_t> datagram = datagram_in(input, what);
    const wire::ReceiveCounters before = reassembly->counters();
    const wire::Sender sender{.address = (what >> 2U) & 3U, .port = 7667};
    wire::Lc02Message message;
    Status status = Status::kOk;
    {
      const WithoutHeap without;
      status = reassembly->accept(datagram, sender, message);
    }
    if (status == Status::kOk) require_sound(message);
    require_counted(before, reassembly->counters(), status);
  }
}

}  // namespace earshot::fuzz
