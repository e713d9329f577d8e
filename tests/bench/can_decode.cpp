// How many CAN frames a second the vehicle reads off its bus, on one core: identifier, source, fast packets, fields, age and fix.

#include <chrono>
#include <cstdio>
#include <vector>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "tests/bench/short_form.hpp"

namespace {

using namespace earshot;
using n2k::Frame;

constexpr int kPositions = 10;  ///< a second, each of which makes a fix

void push(std::vector<Frame>& frames, const n2k::MessageWriter& writer) {
  Frame frame;
  if (writer.frame(n2k::kVehicleAddress, frame) == Status::kOk) frames.push_back(frame);
}

/// A second of a boat's bus: heading, attitude and turn ten times, position too, the rest once; strangers' frames between them.
std::vector<Frame> second_of_a_bus() {
  std::vector<Frame> frames;
  for (int i = 0; i < kPositions; ++i) {
    push(frames, n2k::MessageWriter(n2k::kHeadingPgn).set("Heading", 0.1 * i).set("Reference", 0));
    push(frames, n2k::MessageWriter(n2k::kRateOfTurnPgn).set("Rate", 0.001 * i));
    push(frames, n2k::MessageWriter(n2k::kAttitudePgn).set("Yaw", 0.1).set("Pitch", 0.01 * i).set("Roll", -0.01 * i));
    push(frames, n2k::MessageWriter(n2k::kRudderPgn).set("Instance", 0).set("Position", 0.01 * i));
    if (bench::is_wrong_on_purpose()) continue;
    push(frames, n2k::MessageWriter(n2k::kPositionPgn).set("Latitude", 46.0 + 1e-6 * i).set("Longitude", -1.3));
    push(frames, n2k::MessageWriter(n2k::kWindPgn).set("WindSpeed", 3.0).set("WindAngle", 1.0).set("Reference", 2));
  }
  push(frames, n2k::MessageWriter(n2k::kSpeedPgn).set("SpeedWaterReferenced", 2.0));
  push(frames, n2k::MessageWriter(n2k::kPressurePgn).set("Instance", 0).set("Source", 1).set("Pressure", 3e6));
  push(frames, n2k::MessageWriter(n2k::kWaterDepthPgn).set("Depth", 100.0));
  push(frames, n2k::MessageWriter(n2k::kBatteryPgn).set("Instance", 0).set("Voltage", 24.0));
  const n2k::MessageWriter gnss = n2k::MessageWriter(n2k::kGnssPgn).set("Latitude", 46.0).set("Longitude", -1.3).set("Method", 1);
  n2k::FastPacketFrames packet;
  if (compose_fast_packet(gnss.identifier(n2k::kVehicleAddress), 0, gnss.bytes(), packet) == Status::kOk) {
    frames.insert(frames.end(), packet.begin(), packet.end());
  }
  return frames;
}

}  // namespace

int main() {
  const std::vector<Frame> frames = second_of_a_bus();
  n2k::NavigationReceiver receiver(n2k::LocalPlane::about({.latitude_deg = 46.0, .longitude_deg = -1.3}).value());
  double best_s = 1e9;
  std::uint64_t fixes = 0;
  Time now{1'000'000};
  const int rounds = bench::full_or_short(200, 2);
  constexpr int kSecondsPerRound = 1000;
  for (int round = 0; round < rounds; ++round) {
    const auto began = std::chrono::steady_clock::now();
    for (int second = 0; second < kSecondsPerRound; ++second) {
      for (const Frame& frame : frames) {
        n2k::Fix fix;
        fixes += receiver.accept(frame, now, fix) == Status::kOk ? 1U : 0U;
        now = now + Duration{14'000};
      }
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    best_s = spent.count() < best_s ? spent.count() : best_s;
  }
  // A boat's first fix waits for its heading and its depth.
  const auto expected = static_cast<std::uint64_t>(rounds) * kSecondsPerRound * kPositions;
  if (fixes + kPositions < expected || fixes > expected) {
    std::fprintf(stderr, "%llu fixes were read of %llu\n", static_cast<unsigned long long>(fixes),
                 static_cast<unsigned long long>(expected));
    return 1;
  }
  std::printf("{\"value\": %.4g}\n", kSecondsPerRound * static_cast<double>(frames.size()) / best_s);
  return 0;
}
