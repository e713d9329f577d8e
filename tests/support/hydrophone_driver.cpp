#include "tests/support/hydrophone_driver.hpp"

#include <cstddef>
#include <thread>

#include "firmware/wire/lcm/channels.hpp"

namespace earshot::support {

std::vector<std::uint8_t> encoded(const hydrophone_block_t& block) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(block.getEncodedSize()));
  (void)block.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

HydrophoneDriver::HydrophoneDriver(const std::string& url, const Sound& sound) : endpoint_(host::parse_lcm_url(url), {}) {
  block_.utime = 1'795'000'000'000'000;
  block_.sequence = 0;
  block_.first_sample = 0;
  block_.sample_rate_hz = sound.sample_rate_hz;
  block_.gain_db = 20;
  block_.overflow_count = 0;
  block_.channels = sound.channels;
  block_.sample_count = sound.channels * sound.samples_per_block;
  block_.samples.resize(static_cast<std::size_t>(block_.sample_count));
  for (std::size_t i = 0; i < block_.samples.size(); ++i) block_.samples[i] = static_cast<float>(i % 100) / 100.0F;
}

bool HydrophoneDriver::send() {
  const bool sent = endpoint_.publish(wire::kHydrophoneBlockChannel, encoded(block_)) == Status::kOk;
  advance();
  return sent;
}

void HydrophoneDriver::lose_block() {
  advance();
}

void HydrophoneDriver::advance() {
  const std::int64_t samples = block_.sample_count / block_.channels;
  ++block_.sequence;
  block_.first_sample += samples;
  block_.utime += static_cast<std::int64_t>(1e6 * static_cast<double>(samples) / block_.sample_rate_hz);
}

void HydrophoneDriver::send_in_time_for(std::chrono::milliseconds duration) {
  using std::chrono::steady_clock;
  const auto began = steady_clock::now();
  const std::uint64_t before = taken();
  while (steady_clock::now() < began + duration) {
    (void)send();
    const std::chrono::duration<double> made(static_cast<double>(taken() - before) / block_.sample_rate_hz);
    std::this_thread::sleep_until(began + std::chrono::duration_cast<steady_clock::duration>(made));
  }
}

}  // namespace earshot::support
