#pragma once

#include <cstddef>
#include <string_view>

namespace earshot::wire {

// Channels on a microcontroller's serial line beside those of a journal (firmware/wire/lcm/channels.hpp). To it go pieces of policy and
// tables, then the mission, which arms it; from then on inputs as in a journal, and turns. What a turn says comes back as in a journal,
// health last, so that both keep the same records; but an acknowledgement's channel bears the port that it leaves by, behind a dot.

/// To the board: piece of a `.policy` or `.tables` file: its offset and the file's size, 4 bytes big-endian each, then its bytes.
inline constexpr std::string_view kPolicyPieceChannel = "EARSHOT_POLICY.PIECE";
inline constexpr std::string_view kTablesPieceChannel = "EARSHOT_TABLES.PIECE";
inline constexpr std::size_t kPieceHeadBytes = 8;
inline constexpr std::size_t kPieceBytes = 1024;
/// To the board, before the mission or without any: hearing_t, what it is to listen for in blocks of its hydrophone, which come as
/// hydrophone_block_t on their own channel with the port behind a dot. Each SNR measurement of them is an input of that port; it comes back
/// as in a journal, so that the journal is whole. Blocks bear dates of the turns' clock, and have at most 753 samples: a frame has room for
/// no more.
inline constexpr std::string_view kHearingChannel = "EARSHOT_HEARING";
/// To the board: a turn at the frame's date, after as many inputs and blocks since the mission as its 8 bytes say (big-endian).
inline constexpr std::string_view kTurnChannel = "EARSHOT_TURN";
/// From the board: board_t.
inline constexpr std::string_view kBoardChannel = "EARSHOT_BOARD";

}  // namespace earshot::wire
