#include "firmware/boards/linux/port/bus_trouble.hpp"

#include <array>

#include "firmware/messages/dictionary/journal_fields.hpp"

namespace earshot::board {
namespace {

struct Words {
  std::string_view begin;
  std::string_view end;
  std::string_view hint = {};
};

constexpr std::string_view kCheckCables = "check the cables, their two ends and the bit rate";

constexpr Words words_of(messages::ControllerState trouble) {
  return {messages::to_string(trouble), messages::end_of(trouble), kCheckCables};
}

// In the order of BusTrouble.
constexpr std::array<Words, kBusTroubleCount> kWords{
    Words{"it has no address on the bus, and sends nothing without one: devices with more rights have those that it claims",
          "it has an address on the bus"},
    Words{"another device on the bus has its NAME, or somebody sends its frames back: give one of them another unique_number", ""},
    words_of(messages::ControllerState::kErrorPassive),
    words_of(messages::ControllerState::kBusOff),
    Words{"no position is heard (129025, 129029)", "positions are heard"},
    Words{"positions are heard (129025, 129029), but not from the device that the mission names for position",
          "positions of the named device are heard"},
    Words{"positions are more than 2 degrees from the mission's [origin]", ""},
    Words{"no heading is heard (127250) that is young enough for its position (oldest_part_s)", "headings are heard"},
    Words{"headings are heard (127250), but not from the device that the mission names for heading",
          "headings of the named device are heard"},
    Words{"headings are magnetic, and nobody gives the variation (127258)", ""},
    Words{"no pressure of the water is heard (130314) that is young enough for its position (oldest_part_s)", "pressures are heard"},
    Words{"pressures are heard (130314), but not from the device that the mission names for pressure",
          "pressures of the named device are heard"},
    Words{"there is no depth before a START at the surface: pressures are absolute, and the air's is not known", ""},
    Words{"no SNR is heard (65291)", "SNR is heard"},
    Words{"SNR is heard (65291), but not from the device that the mission names for snr", "SNR of the named device is heard"},
    Words{"frames come faster than they are read, and some are lost", "no more frames are lost"},
    Words{"messages cannot be sent, set-points perhaps among them", "messages are sent",
          "check the bus's load and who acknowledges its frames"},
};

}  // namespace

std::string_view begin_of(BusTrouble trouble) {
  return kWords[static_cast<std::size_t>(trouble)].begin;
}

std::string_view end_of(BusTrouble trouble) {
  return kWords[static_cast<std::size_t>(trouble)].end;
}

std::string_view hint_of(BusTrouble trouble) {
  return kWords[static_cast<std::size_t>(trouble)].hint;
}

}  // namespace earshot::board
