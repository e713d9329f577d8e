// Gives a journal to a microcontroller (firmware/boards/cortex_m7) over its serial line, and holds every byte that it says against what
// stands in the journal.   usage: board_replay JOURNAL LINE [--most-turn-us N]    exit status: 0 all is the same, 1 it is not, 2 bad input

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earshot/board_t.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/transport/serial_line.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/serial/channels.hpp"
#include "firmware/wire/serial/cobs.hpp"
#include "firmware/wire/serial/record_frame.hpp"

namespace {

using namespace earshot;
using host::JournalRecord;

constexpr std::chrono::minutes kPatience{10};

struct Sent {
  std::string channel;
  Time time;
  std::vector<std::uint8_t> data;
};

class Line {
 public:
  explicit Line(const std::string& path) : line_(path) {}

  void send(Time time, std::string_view channel, std::span<const std::uint8_t> data) {
    line_.write(wire::RecordFrame(time, channel, data).bytes(), kPatience);
  }

  Sent next() {
    for (;;) {
      while (at_ < size_) {
        if (reader_.take(bytes_[at_++]) != wire::CobsReader::Outcome::kFrame) continue;
        wire::FramedRecord record;
        if (wire::read_record_frame(reader_.frame(), record) != Status::kOk) throw std::runtime_error("a frame of the board is torn");
        return {std::string(record.channel), record.time, {record.data.begin(), record.data.end()}};
      }
      at_ = 0;
      size_ = line_.read(bytes_, kPatience);
      if (size_ == 0) throw std::runtime_error("the board does not answer");
    }
  }

 private:
  host::SerialLine line_;
  std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(65536);
  std::vector<std::uint8_t> frame_ = std::vector<std::uint8_t>(wire::kFrameBytes);
  std::size_t at_ = 0;
  std::size_t size_ = 0;
  wire::CobsReader reader_{frame_};
};

void store(std::span<std::uint8_t> bytes, std::uint64_t value) {
  for (std::size_t i = bytes.size(); i-- > 0; value >>= 8U) bytes[i] = static_cast<std::uint8_t>(value);
}

void send_file(Line& line, std::string_view channel, const std::vector<std::uint8_t>& file) {
  std::size_t offset = 0;
  do {
    const std::size_t size = std::min(wire::kPieceBytes, file.size() - offset);
    std::vector<std::uint8_t> piece(wire::kPieceHeadBytes + size);
    store(std::span(piece).first(4), offset);
    store(std::span(piece).subspan(4, 4), file.size());
    std::copy_n(file.begin() + static_cast<std::ptrdiff_t>(offset), size, piece.begin() + wire::kPieceHeadBytes);
    line.send({}, channel, piece);
    offset += size;
  } while (offset < file.size());
}

bool is_input(const JournalRecord& record) {
  messages::Input input;
  return wire::read_input(record.channel, record.time, record.data, 0, input) == Status::kOk;
}

/// What a board remembers of itself over a whole journal.
struct Board {
  board_t last{};
  std::int32_t longest_us = 0;
  std::int64_t sum_us = 0;
  int decisions = 0;

  void note(const Sent& sent) {
    if (last.decode(sent.data.data(), 0, static_cast<int>(sent.data.size())) < 0) throw std::runtime_error("no board_t");
    if (last.event == board_t::REFUSED) throw std::runtime_error("the board refuses, status " + std::to_string(last.status));
    if (last.event == board_t::INPUTS_LOST)
      throw std::runtime_error("inputs were lost: " + std::to_string(last.frames_refused) + " frames torn, " +
                               std::to_string(last.bytes_lost) + " bytes lost");
    if (last.event != board_t::DECIDED) return;
    longest_us = std::max(longest_us, last.turn_us);
    sum_us += last.turn_us;
    ++decisions;
  }
};

Sent next_of_turn(Line& line, Board& board) {
  for (;;) {
    Sent sent = line.next();
    if (sent.channel != wire::kBoardChannel) return sent;
    board.note(sent);
  }
}

int play(const std::string& journal, const std::string& path, std::optional<long> most_us) {
  host::JournalReader reader(journal);
  Line line(path);
  JournalRecord mission;
  JournalRecord policy;
  JournalRecord tables;
  if (!reader.next(mission) || !reader.next(policy) || !reader.next(tables)) throw std::runtime_error("the journal has no beginning");
  send_file(line, wire::kPolicyPieceChannel, policy.data);
  send_file(line, wire::kTablesPieceChannel, tables.data);
  line.send(mission.time, wire::kMissionChannel, mission.data);
  Board board;
  do board.note(line.next());
  while (board.last.event != board_t::ARMED);

  std::uint64_t inputs = 0;
  std::uint64_t turns = 0;
  std::uint64_t bytes = 0;
  bool is_in_turn = false;  // the board has been told to make one, and its health has not come
  for (JournalRecord record; reader.next(record) && record.channel != wire::kJournalEndChannel;) {
    if (is_input(record)) {
      line.send(record.time, record.channel, record.data);
      ++inputs;
      continue;
    }
    if (!is_in_turn) {
      std::vector<std::uint8_t> count(8);
      store(count, inputs);
      line.send(record.time, wire::kTurnChannel, count);
      is_in_turn = true;
      ++turns;
    }
    const Sent sent = next_of_turn(line, board);
    const bool is_same_channel = sent.channel == record.channel || sent.channel.starts_with(record.channel + ".");
    if (!is_same_channel || sent.time != record.time || sent.data != record.data) {
      std::printf("record %u, %s at %lld us, is not what the board says (%s at %lld us)\n", record.number, record.channel.c_str(),
                  static_cast<long long>(record.time.us), sent.channel.c_str(), static_cast<long long>(sent.time.us));
      return 1;
    }
    bytes += sent.data.size();
    is_in_turn = record.channel != wire::kHealthChannel;
  }
  std::printf("the same: %llu turns, %d decisions, %llu inputs, %llu bytes of what was said\n", static_cast<unsigned long long>(turns),
              board.decisions, static_cast<unsigned long long>(inputs), static_cast<unsigned long long>(bytes));
  std::printf("turn with a decision: %.3f ms at most, %.3f ms in the mean, by the board's clock\n", board.longest_us / 1e3,
              board.decisions > 0 ? static_cast<double>(board.sum_us) / board.decisions / 1e3 : 0.0);
  std::printf("stack: %d of %d bytes\n", board.last.stack_used_bytes, board.last.stack_bytes);
  std::printf("line: %d frames torn, %d bytes lost\n", board.last.frames_refused, board.last.bytes_lost);
  if (board.last.frames_refused != 0 || board.last.bytes_lost != 0 || board.decisions == 0) return 1;
  if (most_us && board.longest_us > *most_us) {
    std::printf("a turn takes longer than %ld us\n", *most_us);
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 5) {
    std::fputs("usage: board_replay JOURNAL LINE [--most-turn-us N]\n", stderr);
    return 2;
  }
  return play(argv[1], argv[2], argc == 5 ? std::optional(std::stol(argv[4])) : std::nullopt);
} catch (const std::exception& e) {
  std::fprintf(stderr, "board_replay: %s\n", e.what());
  return 2;
}
