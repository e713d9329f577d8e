#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "hil/bench/case.hpp"
#include "hil/nodes/hydrophone.hpp"
#include "hil/nodes/lcm/message.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// Where and with what cases are flown.
struct Bench {
  std::string earshotd = "earshotd";  ///< program beside this one, or a path
  std::string interface = "vcan0";
  std::uint64_t seed = 1;
  SnrOfRange snr;                          ///< of the source
  Meters floor_depth;                      ///< of the sea
  std::filesystem::path environment = {};  ///< file (TOML) that both are of; of cases with a speed alone
  const std::atomic<bool>& stop;
};

/// What a case needs of this machine is not there: it was not flown.
class NotFlown : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where the vehicle truly was.
struct TruePlace {
  Time time;
  NorthEast position;
  Meters depth;
};

/// A frame of the trace.
struct TracedFrame {
  Time time;
  bool from_earshot = false;
  n2k::Frame frame;
};

/// A message of the trace of an LCM bus; one that is none is on channel "?".
struct TracedMessage {
  Time time;
  bool from_earshot = false;
  LcmMessage message;
};

/// What came of a flight.
struct BenchFlight {
  std::filesystem::path folder;                          ///< of its journal, of what earshotd said (words.txt), and of its track
  std::string not_flown;                                 ///< what this machine lacks for it; empty: it was
  std::string failure;                                   ///< why it could not be flown to its end; empty: it was
  messages::EndReason end = messages::EndReason::kNone;  ///< by the last answer
  bool is_end_heard = true;                              ///< false: Earshot could not say it; the journal alone knows
  std::vector<std::string> uncounted;                    ///< faults that the kernel has not counted, in words
  std::vector<int> exit_statuses;                        ///< of every earshotd, in order; 128 and a signal's number
  std::string last_words;                                ///< of the last earshotd
  Time began;                                            ///< time 0 of the flight, as its journal dates it
  Time last;                                             ///< of the last tick
  double wall_s = 0.0;
  std::vector<TruePlace> track;        ///< one a second
  std::deque<TracedFrame> trace;       ///< of a CAN bus, the last of them
  std::deque<TracedMessage> messages;  ///< of an LCM bus, the last of them
  std::uint64_t sent = 0;              ///< frames, or LCM's datagrams
  std::uint64_t received = 0;          ///< frames, of Earshot's
  std::uint64_t lost = 0;              ///< frames that the kernel says it lost
  std::uint64_t refused = 0;           ///< frames for which it had no room (ENOBUFS)
  std::uint64_t afflicted = 0;         ///< how often a fault did something to a frame, or to a message
  std::vector<TimedFault> idle;        ///< faults of the case that never began to act, in its order
  bool is_weight_released = false;     ///< the vehicle was asked for it
};

}  // namespace earshot::hil
