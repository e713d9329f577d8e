#include "firmware/boards/linux/replay/replay.hpp"

#include "firmware/boards/linux/replay/playback.hpp"

namespace earshot::board {

ReplayResult replay(const std::filesystem::path& path) {
  Playback playback(path);
  while (playback.next()) {
  }
  ReplayResult result{.inputs = playback.memory().inputs,
                      .turns = playback.turns(),
                      .decisions = playback.decisions(),
                      .difference = playback.difference(),
                      .gap = playback.gap(),
                      .closing = playback.closing(),
                      .damages = {}};
  result.end = playback.file().end();
  result.damages = playback.file().damages();
  if (result.is_same() && !playback.unwritten().empty()) result.gap = playback.next_number();  // its last turn is not whole
  return result;
}

}  // namespace earshot::board
