#include "firmware/boards/linux/replay/replay.hpp"

#include "firmware/boards/linux/replay/playback.hpp"

namespace earshot::board {

ReplayResult replay(const std::filesystem::path& path, const ReplayOptions& options) {
  constexpr std::uint32_t kBetweenUpdates = 4096;
  Playback playback(path, options.from_step);
  const Time began = playback.memory().last;
  while (playback.next()) {
    if (options.progress && playback.next_number() % kBetweenUpdates == 0)
      options.progress(static_cast<double>(playback.file().offset()) / static_cast<double>(playback.file().file_size() + 1));
  }
  ReplayResult result{.inputs = playback.memory().inputs,
                      .turns = playback.turns(),
                      .decisions = playback.decisions(),
                      .was_compared = playback.is_comparing(),
                      .began = began,
                      .ended = playback.memory().last,
                      .difference = playback.difference(),
                      .gap = playback.gap(),
                      .closing = playback.closing(),
                      .records_behind_end = playback.records_behind_end(),
                      .damages = {}};
  result.end = playback.file().end();
  result.damages = playback.file().damages();
  if (result.is_same() && !playback.unwritten().empty()) result.gap = playback.next_number();  // its last turn is not whole
  return result;
}

}  // namespace earshot::board
