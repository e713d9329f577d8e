// Flies the recorded mission and says of every decision what it came to, bit for bit.
// usage: bits          (status 1: something is not as recorded)
//        bits record   (flies it by its own decisions, and writes what recorded.hpp has below its includes)
#include <bit>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <vector>

#include "tests/bits/mission.hpp"

namespace {

using namespace earshot;
using namespace earshot::bits;

Mission mission;

int refused() {
  std::fprintf(stderr, "bits: the core refuses the mission\n");
  return 2;
}

int record() {
  if (mission.begin(Track::kFlown) != Status::kOk) return refused();
  std::vector<Line> lines;
  do {
    lines.push_back(mission.fly());
  } while (!lines.back().is_end);
  std::printf("namespace earshot::bits {\n\n/// Of each decision.\ninline constexpr std::array<Corner, %zu> kTrack{{\n", lines.size() - 1);
  for (const Line& line : lines) {
    if (line.is_end) break;
    std::printf("    {%d, %d, %d, %d, %d},\n", static_cast<int>(line.corner.second), static_cast<int>(line.corner.north),
                static_cast<int>(line.corner.east), static_cast<int>(line.corner.heading), static_cast<int>(line.corner.bearing));
  }
  std::printf("}};\n\n/// After each decision, and at the end.\ninline constexpr std::array<std::uint32_t, %zu> kDigests{\n", lines.size());
  for (const Line& line : lines) std::printf("    0x%08X,\n", static_cast<unsigned>(line.digest));
  std::printf("};\n\n}  // namespace earshot::bits\n");
  return 0;
}

int check() {
  if (mission.begin(Track::kRecorded) != Status::kOk) return refused();
  Line line;
  bool is_same = true;
  for (std::size_t number = 0; is_same && !line.is_end; ++number) {
    line = mission.fly();
    is_same = is_as_recorded(number, line);
    std::printf("%3d s  ", static_cast<int>(line.second));
    if (line.is_end) {
      std::printf("end");
    } else {
      std::printf("step %2u  SNR 0x%016llX (%.2f dB)  action %u", static_cast<unsigned>(line.step),
                  static_cast<unsigned long long>(line.snr_bits), std::bit_cast<double>(line.snr_bits), line.action);
    }
    std::printf("  looks %u  set-points %u  digest 0x%08X%s\n", static_cast<unsigned>(line.measurements),
                static_cast<unsigned>(line.setpoints), static_cast<unsigned>(line.digest),
                is_same ? "" : "  differs from what was recorded");
  }
  return is_same ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return argc == 2 && std::strcmp(argv[1], "record") == 0 ? record() : check();
}
