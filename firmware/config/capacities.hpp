#pragma once

#include <cstddef>
#include <cstdint>

namespace earshot::config {

// Every size of the fixed-memory core, with its unit, its reason and what happens when it is full.

/// What the core is compiled for, by -DEARSHOT_CAPACITY_PROFILE=kMicrocontroller; left out, a vehicle computer.
enum class Profile : std::uint8_t {
  kVehicleComputer,       ///< an operating system and megabytes: every policy that can be trained
  kRoomyMicrocontroller,  ///< bare metal with 620 KiB in all: every policy that ships, and none of a larger network
  kMicrocontroller,  ///< bare metal; the state, with a coarser belief in fewer oceans, in a Cortex-M7's 128 KiB of tightly coupled memory,
                     ///< which it nearly fills: the stack lies elsewhere
  kWithoutBelief,    ///< bare metal with some 100 KiB in all: policies that go by what was heard last; one with a belief is refused at load
};
#ifndef EARSHOT_CAPACITY_PROFILE
#define EARSHOT_CAPACITY_PROFILE kVehicleComputer
#endif
inline constexpr Profile kProfile = Profile::EARSHOT_CAPACITY_PROFILE;

/// A size that differs between profiles.
consteval std::size_t by_profile(std::size_t vehicle_computer, std::size_t roomy, std::size_t microcontroller, std::size_t without_belief) {
  switch (kProfile) {
    case Profile::kVehicleComputer:
      return vehicle_computer;
    case Profile::kRoomyMicrocontroller:
      return roomy;
    case Profile::kMicrocontroller:
      return microcontroller;
    case Profile::kWithoutBelief:
      break;
  }
  return without_belief;
}
consteval std::size_t by_profile(std::size_t vehicle_computer, std::size_t microcontroller, std::size_t without_belief) {
  return by_profile(vehicle_computer, vehicle_computer, microcontroller, without_belief);
}
consteval std::size_t by_profile(std::size_t vehicle_computer, std::size_t microcontroller) {
  return by_profile(vehicle_computer, microcontroller, microcontroller);
}

/// Elements of an observation (m = 21 remembered steps of 3); full: policy refused at load.
inline constexpr std::size_t kMaxObservation = 64;
/// Compass directions (one every 11.25 or 22.5 degrees); full: policy refused at load.
inline constexpr std::size_t kMaxActions = by_profile(32, 16);
/// Units of a hidden layer (256 are the widest in common use; Stable-Baselines3's default are 64); full: policy refused at load, with its
/// size.
inline constexpr std::size_t kMaxLayerWidth = by_profile(256, 64, 64, 64);
/// Hidden layers (as many as policies of so few observations are trained with); full: policy refused at load.
inline constexpr std::size_t kMaxHiddenLayers = 3;
/// Weights and biases of a network, in blocks of 64 outputs, of the last layer 8 (every network of those sizes; on bare metal two layers of
/// 64 units, or less in three); full: policy refused at load, with its size.
inline constexpr std::size_t kMaxNetworkNumbers = kMaxLayerWidth * (kMaxObservation + 1) +
                                                  by_profile(2, 1, 1, 1) * kMaxLayerWidth * (kMaxLayerWidth + 1) +
                                                  kMaxActions * (kMaxLayerWidth + 1);
/// Steps in the memory state; full: the oldest step is forgotten.
inline constexpr std::size_t kMaxRememberedSteps = 21;
/// Cells of the belief (25 km x 25 km in cells of 500 m or 1 km); full: policy refused at load.
inline constexpr std::size_t kMaxBeliefCells = by_profile(2500, 625, 16);
/// Oceans believed possible at the mission's place (a year's sound speed times a handful of sea floors and depths); full: tables refused at
/// load, and `earshot tables` makes one of those that are most alike.
inline constexpr std::size_t kMaxOceanTables = by_profile(96, 32, 3);
/// Ranges of each of them (51 km in steps of 100 m, 38 km in steps of 300 m: the diagonal of 25 km x 25 km is 35.4 km); full: tables
/// refused at load.
inline constexpr std::size_t kMaxTableRanges = by_profile(512, 128, 2);
/// Bytes of the name of such an ocean; full: `earshot tables` cuts it off.
inline constexpr std::size_t kMaxTableName = 32;
/// Blocks of eight retained hypotheses about ocean, level, fluctuation, pauses and motion, each with a grid of 16 bits a cell and
/// hypothesis; full: the least likely gives way.
inline constexpr std::size_t kBeliefBlocks = by_profile(3, 3, 2);
/// Measurements by which hypotheses are weighed that are not retained (18 h of one every 500 s); full: the retained ones are all.
inline constexpr std::size_t kMaxBeliefMeasurements = by_profile(128, 128, 1);
/// Measurements of such others that are weighed in one go, between two decisions; full: the next go weighs on.
inline constexpr std::size_t kMeasurementsInASlice = by_profile(50, 5);
/// Sources that the tables think possible, by which silence is judged to be long (of 1024 a few are left where one in 256 is unheard, at a
/// byte each); full: never, there are as many.
inline constexpr std::size_t kSilentSources = by_profile(1024, 1024, 32);
/// Bytes of the belief about the source, with its tables; full: does not compile.
inline constexpr std::size_t kOceanBeliefBytes = by_profile(260, 64, 4) * 1024;
/// Seconds that a decision may listen over (a blue whale calls every one or two minutes); full: policy refused at load.
inline constexpr std::size_t kMaxListeningSeconds = by_profile(120, 60);
/// Searches that are flown again before a policy is trusted; a policy has exactly this many.
inline constexpr std::size_t kGoldenTrajectories = 2;
/// Steps of each of these searches (enough for a belief to take shape, all flown in 1 ms); a policy has exactly this many.
inline constexpr std::size_t kGoldenSteps = 6;
/// Bytes of provenance text in a policy, or in ocean tables; full: refused when they are made.
inline constexpr std::size_t kMaxProvenance = 1024;
/// Bytes of it that are kept when a file is read (people read it in a vehicle computer's reports; a microcontroller shows it to nobody);
/// full: passed over.
inline constexpr std::size_t kKeptProvenance = by_profile(kMaxProvenance, 0);
/// Bytes of the whole on-vehicle state (nearly all of them belief, ocean tables and policy weights); full: does not compile.
inline constexpr std::size_t kRuntimeBytes = by_profile(904, 333, 128, 72) * 1024;

// Inputs and commands (firmware/messages, firmware/runtime).
/// Ports of a vehicle (buses, serial lines, the simulation link); full: mission refused.
inline constexpr std::size_t kMaxPorts = 8;
/// Issuers of commands that are known again when their next command comes; full: the one silent for longest gives way.
inline constexpr std::size_t kMaxIssuers = 8;
/// Commands acknowledged in one turn; full: judged, counted, not acknowledged.
inline constexpr std::size_t kMaxAcknowledgements = 8;
/// Microseconds between a command's date and its arrival, at most (a slow link, clocks apart); older: refused.
inline constexpr std::int64_t kCommandMaxAge_us = 30'000'000;

// Safety (firmware/safety).
/// Corners of a fence's polygon or of a zone; more: mission refused.
inline constexpr std::size_t kMaxPolygonCorners = 16;
/// Zones where the vehicle may not surface (a fairway, a port, two wind farms); more: mission refused.
inline constexpr std::size_t kMaxNoSurfaceZones = 4;
/// Corrections of a dead reckoning that count at once (500 m within ten minutes, each more than 25 m); more: not believed.
inline constexpr std::size_t kMaxCorrections = 20;
/// Rules of a mission's own (each of the conditions once, but for those that stand in every mission without a limit to choose); more:
/// mission refused.
inline constexpr std::size_t kMaxOwnRules = 25;
/// Rules with those that no mission can switch off (at most 14).
inline constexpr std::size_t kMaxRules = kMaxOwnRules + 14;

// LCM (firmware/wire/lcm, firmware/boards/linux).
/// Bytes of one LCM message (1 s of float samples at 32 kHz); full: refused, counted.
inline constexpr std::size_t kLcmMessageBytes = 131'072;
/// Channels one endpoint listens to (8 types, both directions); full: open fails.
inline constexpr std::size_t kLcmSubscriptions = 16;
/// Messages waiting per channel between two steps; full: the oldest goes, counted.
inline constexpr std::size_t kLcmQueueDepth = 4;
/// Fragmented messages in the making; full: the least recently fed goes, counted.
inline constexpr std::size_t kLcmReassemblySlots = 4;
/// Datagrams read in one turn (a flood cannot hold the loop); full: the rest waits for the next turn.
inline constexpr std::size_t kLcmDatagramsPerCollect = 256;

// The loop (firmware/boards/linux).
/// Microseconds between two turns, at least, where arrivals make them (500 turns a second); sooner: what came waits for the next turn.
inline constexpr std::int64_t kLeastBetweenTurns_us = 2000;

// Sound (firmware/boards/linux/hydrophone).
/// Channels of one ADC (a small array; a microcontroller has one hydrophone); full: the block is malformed, counted.
inline constexpr std::size_t kHydrophoneChannels = by_profile(8, 1);
/// Floats between receiving and listening (2.7 s of 96 kHz x 8 channels, 8 MiB); full: the newest block goes, counted.
inline constexpr std::size_t kHydrophoneRingSamples = 2'097'152;
/// Blocks of them (5 s of blocks of 128 samples at 96 kHz); full: the newest block goes, counted.
inline constexpr std::size_t kHydrophoneRingBlocks = 4096;

/// Measurements between listening and the loop (25 s of the shortest integration time); full: the newest goes, counted.
inline constexpr std::size_t kHydrophoneMeasurements = 256;
/// Detections between listening and the loop (one lasts a quarter of a second at least); full: the newest goes, counted.
inline constexpr std::size_t kHydrophoneDetections = 64;

// CAN and NMEA 2000 (firmware/wire/n2k, firmware/boards/linux).
/// CAN frames read in one turn (250 kbit/s carry at most about 2000 in a second, which has ten turns); full: the rest waits for the
/// next turn.
inline constexpr std::size_t kCanFramesPerCollect = 1024;
/// Entries of a socket's filter in the kernel (every group of NMEA 2000 that is read, and those sent to us); full: refused at the start.
inline constexpr std::size_t kCanFilters = 64;
/// CAN frames that may wait in the kernel (1 s of a full bus of 1 Mbit/s); full: the kernel drops the newest, counted.
inline constexpr std::size_t kCanReceiveRoomFrames = 8000;
/// Groups of CAN frames that wait for room in the interface (what a node may answer in one step, set-points and reports beside it);
/// full: the oldest of the least urgent goes, counted.
inline constexpr std::size_t kCanWaitingGroups = 24;
/// NMEA 2000 fast packets in the making (senders x PGNs). A slot is held from a message's first frame to its last, by each device that
/// sends one at that time. A bus has up to 50 devices, and what is put together here more than one of them sends: positions of GNSS
/// receivers, plotters and autopilots, and 126720, which every maker uses for messages of his own. With eight, nine that begin within the
/// 50 ms of a long message would lose one. On a microcontroller's bus, which is its vehicle's alone, eight: 250 kbit/s carry the 32 frames
/// of the longest message in 20 ms, the 8 of a position in 5, and a vehicle has two receivers, an autopilot and a battery or two that send
/// what is put together there. Were there twenty, each once a second and 50 ms long, one message in 550 000 would begin as a ninth, and
/// what it says comes again within a second. Full: the one fed longest ago goes, counted.
inline constexpr std::size_t kFastPacketSlots = by_profile(16, 8);
/// Of one assembly: 280 bytes a slot and its counters. A CAN port holds two, for positions and for orders.
inline constexpr std::size_t kFastPacketBytes = by_profile(4608, 2304);
/// Devices whose NAMEs are known by their addresses (every address that there is; a network of NMEA 2000 has 50 devices at most, and some
/// claim two addresses); full: one more is known by its address alone, as if it had claimed none, and is counted. So it is taken for
/// another device when its address changes, and is never one that the mission names.
inline constexpr std::size_t kKnownDevices = by_profile(254, 64);

/// Devices that watch the hull and have an alarm at one time (one or two in each of a vehicle's compartments); full: the alarm of one more
/// stands until earshotd ends.
inline constexpr std::size_t kHullAlarms = 16;

// Journal (firmware/host/journal).
/// Journal bytes waiting for the disk, 4 MiB of them streams (1 s of the largest bus load); full: drop newest, count.
inline constexpr std::size_t kJournalBufferBytes = 6'291'456;
/// Bytes of kJournalBufferBytes that streams leave to set-points and decisions (10 000 set-points, one a second for nearly 3 h);
/// full: drop newest, count.
inline constexpr std::size_t kJournalSteeringReserveBytes = 1'048'576;
/// Bytes of kJournalBufferBytes that all others leave to mission, commands and changes of state (12 000 commands); full: drop
/// newest, count.
inline constexpr std::size_t kJournalOrderReserveBytes = 1'048'576;

// Sound (firmware/detector/hydrophone).
/// Taps of a decimator (96 kHz down to the 320 Hz that a band up to 10 Hz needs first, 80 dB down; a microcontroller's ADC has a few kHz);
/// more: no such band may be asked for.
inline constexpr std::size_t kFirTaps = by_profile(1632, 256);
/// Taps of the second decimator (from 64 to 4 times the band's high end, 80 dB down); more: no such band may be asked for.
inline constexpr std::size_t kSecondFirTaps = 224;
/// Samples of one channel that are filtered in one go (what stays in a processor's first cache; a microcontroller keeps four times as many
/// floats, and 256 would take 2 KiB more than 128 to save a hundredth of the instructions); more: the next go.
inline constexpr std::size_t kSoundChunk = by_profile(1024, 128);
/// Levels that a noise floor remembers (2 minutes of a quarter of a second, 8 minutes of a second; of a microcontroller 5 minutes of two
/// seconds); full: the oldest goes.
inline constexpr std::size_t kFloorLevels = by_profile(512, 160);
/// Rises by 1 dB within the last 10 dB of a sound; never full: an eleventh is 10 dB under the loudest.
inline constexpr std::size_t kExtentRises = 12;

}  // namespace earshot::config
