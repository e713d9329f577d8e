#include "sim/recording/harp.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "sim/recording/utc.hpp"

namespace earshot::recording {
namespace {

// Bytes of the table: what stands before the raw files, and of each; both have four more for each channel in version 2.
constexpr std::size_t kHead_bytes = 56;
constexpr std::size_t kEntry_bytes = 32;
constexpr std::size_t kCount_at = 36;
constexpr std::size_t kRate_at = 20;
/// The clock of the table counts milliseconds.
constexpr Duration kClockStep = Duration::milliseconds(2);

std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i > 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[at + i - 1]);
  return value;
}

std::optional<Time> time_of(std::string_view entry) {
  const auto field = [entry](std::size_t at) { return static_cast<int>(number(entry, at, 1)); };
  const std::optional<Time> time =
      utc({.year = 2000 + field(0), .month = field(1), .day = field(2), .hour = field(3), .minute = field(4), .second = field(5)});
  const std::uint64_t milliseconds = number(entry, 6, 2);
  if (!time || milliseconds > 999) return std::nullopt;
  return *time + Duration::milliseconds(static_cast<std::int64_t>(milliseconds));
}

Time end_of(const ClockedRun& run, Hertz rate) {
  return run.start + Duration{std::llround(static_cast<double>(run.frames) / rate.value * 1e6)};
}

/// Where a raw file lies among the samples.
std::optional<ClockedRun> run_of(std::string_view entry, const HarpSamples& samples) {
  const std::optional<Time> start = time_of(entry);
  const std::uint64_t at = number(entry, 8, 4);
  const std::uint64_t bytes = number(entry, 12, 4);
  if (!start || at < samples.begin || (at - samples.begin) % samples.frame_bytes != 0 || bytes % samples.frame_bytes != 0)
    return std::nullopt;
  return ClockedRun{.first_frame = (at - samples.begin) / samples.frame_bytes, .frames = bytes / samples.frame_bytes, .start = *start};
}

/// The raw files' entries, all as long; nothing where the table is shorter than it says.
std::vector<std::string_view> entries_of(std::string_view table, std::size_t channels) {
  if (table.size() < kHead_bytes) return {};
  // Some writers give the version's number, some its letter.
  const bool is_second = table.front() == 2 || table.front() == '2';
  const std::size_t more = is_second ? 4 * channels : 0;
  const std::size_t size = kEntry_bytes + more;
  const auto count = static_cast<std::size_t>(number(table, kCount_at, 2));
  if (table.size() < kHead_bytes + more + count * size) return {};
  std::vector<std::string_view> entries;
  for (std::size_t i = 0; i < count; ++i) entries.push_back(table.substr(kHead_bytes + more + i * size, size));
  return entries;
}

}  // namespace

std::optional<Hertz> harp_rate(std::string_view table, std::size_t channels) {
  const std::vector<std::string_view> entries = entries_of(table, channels);
  if (entries.empty()) return std::nullopt;
  const std::uint64_t rate = number(entries.front(), kRate_at, 4);
  const bool is_one =
      rate > 0 && std::ranges::all_of(entries, [rate](std::string_view entry) { return number(entry, kRate_at, 4) == rate; });
  return is_one ? std::optional(Hertz{static_cast<double>(rate)}) : std::nullopt;
}

std::vector<ClockedRun> harp_runs(std::string_view table, const HarpSamples& samples) {
  std::vector<ClockedRun> runs;
  std::uint64_t next = 0;
  for (const std::string_view entry : entries_of(table, samples.channels)) {
    if (next == samples.frames) break;
    std::optional<ClockedRun> run = run_of(entry, samples);
    if (!run || run->frames == 0 || run->first_frame != next) return {};
    run->frames = std::min(run->frames, samples.frames - next);
    next += run->frames;
    const bool follows_on = !runs.empty() && std::abs((run->start - end_of(runs.back(), samples.sample_rate)).us) <= kClockStep.us;
    if (follows_on)
      runs.back().frames += run->frames;
    else
      runs.push_back(*run);
  }
  return next == samples.frames ? runs : std::vector<ClockedRun>{};
}

}  // namespace earshot::recording
