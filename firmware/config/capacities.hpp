#pragma once

#include <cstddef>
#include <cstdint>

namespace earshot::config {

// Every size of the fixed-memory core, with its unit, its reason and what happens when it is full.

/// What the core is compiled for, by -DEARSHOT_CAPACITY_PROFILE=kMicrocontroller; left out, a vehicle computer.
enum class Profile : std::uint8_t {
  kVehicleComputer,  ///< an operating system and megabytes: every policy that can be trained
  kMicrocontroller,  ///< bare metal; the state in half of a Cortex-M7's 128 KiB of tightly coupled memory, for a coarser belief
};
#ifndef EARSHOT_CAPACITY_PROFILE
#define EARSHOT_CAPACITY_PROFILE kVehicleComputer
#endif
inline constexpr Profile kProfile = Profile::EARSHOT_CAPACITY_PROFILE;

/// A size that differs between profiles.
consteval std::size_t by_profile(std::size_t vehicle_computer, std::size_t microcontroller) {
  return kProfile == Profile::kVehicleComputer ? vehicle_computer : microcontroller;
}

inline constexpr std::size_t kMaxObservation =
    64;  ///< elements of an observation (m = 21 remembered steps of 3); full: policy refused at load
inline constexpr std::size_t kMaxActions =
    by_profile(32, 16);  ///< compass directions (one every 11.25 or 22.5 degrees); full: policy refused at load
inline constexpr std::size_t kMaxLayerWidth =
    64;  ///< units of a hidden layer (Stable-Baselines3's 64-64 default); full: policy refused at load
inline constexpr std::size_t kMaxHiddenLayers = 2;      ///< hidden layers; full: policy refused at load
inline constexpr std::size_t kMaxRememberedSteps = 21;  ///< steps in the memory state; older steps are forgotten
inline constexpr std::size_t kMaxBeliefCells =
    by_profile(2500, 625);  ///< cells of the belief (25 km x 25 km in cells of 500 m or 1 km); full: policy refused at load
inline constexpr std::size_t kMaxBeliefHypotheses = 4;  ///< source levels and spreads believed possible; full: policy refused at load
inline constexpr std::size_t kMaxBeliefRanges =
    by_profile(512, 256);  ///< samples of the SNR against range (51 km in steps of 100 or 200 m); full: policy refused at load
inline constexpr std::size_t kBeliefBytes = by_profile(64, 20) * 1024;  ///< bytes of the belief about the source; full: does not compile
inline constexpr std::size_t kMaxListeningSeconds = by_profile(
    120, 60);  ///< seconds that a decision may listen over (a blue whale calls every one or two minutes); full: policy refused at load
inline constexpr std::size_t kGoldenTrajectories = 2;  ///< searches flown again before a policy is trusted; exactly this many
inline constexpr std::size_t kGoldenSteps = 6;         ///< steps of each (a belief takes shape, all in 1 ms); exactly this many
inline constexpr std::size_t kMaxProvenance = 1024;    ///< bytes of provenance text in a policy; full: refused at freeze
inline constexpr std::size_t kRuntimeBytes =
    by_profile(120, 64) * 1024;  ///< bytes of the whole on-vehicle state, nearly all policy weights and belief; full: does not compile

// Inputs and commands (firmware/messages, firmware/runtime).
inline constexpr std::size_t kMaxPorts = 8;  ///< ports of a vehicle (buses, serial lines, the simulation link); full: mission refused
inline constexpr std::size_t kMaxIssuers =
    8;  ///< who gave commands, newest first to be known again; full: the one silent for longest gives way
inline constexpr std::size_t kMaxAcknowledgements = 8;  ///< commands acknowledged in one turn; full: judged, counted, not acknowledged
inline constexpr std::int64_t kCommandMaxAge_us = 30'000'000;  ///< between a command's date and its arrival (a slow link, clocks apart)

// Buses (firmware/wire, firmware/boards/linux).
inline constexpr std::size_t kLcmMessageBytes =
    131'072;                                          ///< bytes of one LCM message (1 s of float samples at 32 kHz); full: refused, counted
inline constexpr std::size_t kLcmSubscriptions = 16;  ///< channels one endpoint listens to (8 types, both directions); full: open fails
inline constexpr std::size_t kLcmQueueDepth = 4;      ///< messages waiting per channel between two steps; full: the oldest goes, counted
inline constexpr std::size_t kLcmReassemblySlots = 4;  ///< fragmented messages in the making; full: the least recently fed goes, counted
inline constexpr std::size_t kLcmDatagramsPerCollect =
    256;  ///< datagrams read in one turn, so that a flood cannot hold the loop; more: next turn
// Sound (firmware/boards/linux/hydrophone).
inline constexpr std::size_t kHydrophoneChannels = 8;  ///< of one ADC (a small array); more: block malformed, counted
inline constexpr std::size_t kHydrophoneRingSamples =
    2'097'152;  ///< floats between receiving and listening (2.7 s of 96 kHz x 8 channels, 8 MiB); full: the newest block goes, counted
inline constexpr std::size_t kHydrophoneRingBlocks =
    4096;  ///< blocks of them (5 s of blocks of 128 samples at 96 kHz); full: the newest block goes, counted

inline constexpr std::size_t kCanFramesPerCollect =
    1024;  ///< frames read in one turn (250 kbit/s carry at most about 2000 in a second, a turn looks ten times in one); more: next turn
inline constexpr std::size_t kJournalBufferBytes =
    6'291'456;  ///< bytes waiting for the disk, 4 MiB of them streams (1 s of the largest bus load); full: drop newest, count
inline constexpr std::size_t kJournalSteeringReserveBytes =
    1'048'576;  ///< of these, kept from streams for set-points and decisions (10 000 set-points, one a second for nearly 3 h); full: drop
                ///< newest, count
inline constexpr std::size_t kJournalOrderReserveBytes =
    1'048'576;  ///< of these, kept from all but mission, commands and changes of state (12 000 commands); full: drop newest, count
inline constexpr std::size_t kFastPacketSlots =
    8;  ///< NMEA 2000 fast packets in the making (senders x PGNs); full: the oldest goes, counted

}  // namespace earshot::config
