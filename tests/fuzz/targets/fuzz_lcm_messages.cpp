// LCM messages of every type that a vehicle reads, decoded and given to a runtime.
//
// The input is a row of messages, each: how much later it comes (1 byte, 20 ms each), of which type (1), how its bytes are spoilt (see
// spoil()). A type's bytes begin as those of a message of zeros, with the type's fingerprint.

#include <cmath>
#include <type_traits>
#include <vector>

#include "earshot/hydrophone_block_t.hpp"
#include "firmware/safety/check.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/hydrophone_block.hpp"
#include "firmware/wire/lcm/order_reader.hpp"
#include "tests/fuzz/targets/flown_runtime.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::fuzz {
namespace {

/// These with the input's bytes over them; the last is cut off now and then.
std::vector<std::uint8_t> bytes_in(Input& input, std::span<const std::uint8_t> message) {
  std::vector<std::uint8_t> bytes(message.begin(), message.end());
  spoil(bytes, input);
  if (!input.is_used_up() && input.byte() % 16 == 1) bytes.pop_back();
  return bytes;
}

/// What a port makes of an order, whole or not: only an ABORT may be less than whole, and one that is whole is read as it stands.
void judge_order(const std::vector<std::uint8_t>& bytes, Status whole) {
  wire::ReadOrder read;
  {
    const WithoutHeap without;
    read = wire::read_order(bytes);
  }
  require((read.form == wire::OrderForm::kWhole) == (whole == Status::kOk), "an order is whole for one reader and not for the other");
  require(read.form != wire::OrderForm::kAbort || read.command.order == messages::Order::kAbort, "something else is obeyed by half");
}

template <class Message>
void give(FlownRuntime& runtime, Input& input, Duration later, const Message& zeros) {
  Message message = zeros;
  const std::vector<std::uint8_t> bytes = bytes_in(input, wire::Encoded(zeros).bytes());
  Status status = Status::kOk;
  {
    const WithoutHeap without;
    status = wire::decode(bytes, message);
  }
  if constexpr (std::is_same_v<Message, messages::OperatorCommand>) judge_order(bytes, status);
  if (status == Status::kOk) runtime.take(message, later);
}

void read_block(Input& input) {
  hydrophone_block_t zeros{};
  zeros.sample_rate_hz = 8000.0;
  zeros.channels = 1;
  zeros.sample_count = 8;
  zeros.samples.resize(8);
  const std::vector<std::uint8_t> bytes = bytes_in(input, support::bytes_of(zeros));
  wire::HydrophoneMessage message;
  Status status = Status::kOk;
  {
    const WithoutHeap without;
    status = wire::read_hydrophone_block(bytes, message);
  }
  if (status != Status::kOk) return;
  require(message.sample_count() == std::size_t{message.block.samples_per_channel} * message.block.channels, "samples are missing");
  require(message.block.sample_rate >= messages::kLowestSampleRate && message.block.sample_rate <= messages::kHighestSampleRate,
          "a sample rate that cannot be");
  require(std::abs(message.block.gain.value) <= messages::kHighestGain.value, "a gain that cannot be");
  std::vector<float> samples(message.sample_count());
  wire::copy_samples(message, samples);
}

void read_mission(Input& input) {
  static const messages::MissionRecord zeros{.mission = support::mission_for(support::random_walk_policy())};
  messages::MissionRecord message;
  if (wire::decode(bytes_in(input, wire::Encoded(zeros).bytes()), message) != Status::kOk) return;
  const config::Mission& mission = message.mission;
  if (config::check(mission) != Status::kOk || !safety::check(mission).is_none()) return;  // the fence is the latter's
  require(std::isfinite(mission.search_depth.value) && mission.search_depth <= mission.max_depth, "a mission dives too deep");
  messages::MissionRecord again;
  require(wire::decode(wire::Encoded(message).bytes(), again) == Status::kOk && again.mission == mission,
          "a mission is another after it was written");
}

void start(FlownRuntime& runtime) {
  messages::OperatorCommand command{.time = runtime.now(), .expiry = runtime.now() + Duration::seconds(60), .issuer = 1, .number = 1};
  command.order = messages::Order::kStart;
  runtime.take(command, {});
}

}  // namespace

void judge(std::span<const std::uint8_t> bytes) {
  FlownRuntime runtime;
  start(runtime);
  for (Input input(bytes); !input.is_used_up();) {
    const Duration later = Duration::milliseconds(20 * input.byte());
    const Time now = runtime.now() + later;
    const std::uint8_t kind = input.byte();
    switch (kind % 10) {
      case 0:
        give(runtime, input, later, dated<messages::Navigation>(now));
        break;
      case 1:
        give(runtime, input, later, dated<messages::SnrMeasurement>(now));
        break;
      case 2:
        give(runtime, input, later, dated<messages::OperatorCommand>(now));
        break;
      case 3:
        give(runtime, input, later, dated<messages::VehicleStatus>(now));
        break;
      case 4:
        give(runtime, input, later, dated<messages::AutopilotStatus>(now));
        break;
      case 5:
        if (kind < 128) {
          give(runtime, input, later, dated<messages::HydrophoneStatus>(now));
        } else {
          auto measured = dated<messages::BearingMeasurement>(now);
          measured.bearing = {.direction = Radians{1.0}, .deviation = Radians{0.2}, .mirror_axis = Radians{0.5}};
          give(runtime, input, later, measured);
        }
        break;
      case 6:
        if (kind < 128) {
          give(runtime, input, later, messages::PortReport{});
        } else {
          give(runtime, input, later, messages::UnsentSetpoints{});
        }
        break;
      case 7:
        read_mission(input);
        break;
      case 8:
        read_block(input);
        break;
      default:
        runtime.take(messages::PortReport{}, later);
        static_cast<void>(runtime.step());
    }
  }
  static_cast<void>(runtime.step());
}

}  // namespace earshot::fuzz
