#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/boards/linux/event_log/log_format.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/program/command_line.hpp"

namespace earshot::board {

/// The command line of earshotd.
struct Options {
  std::filesystem::path mission;
  std::filesystem::path out = ".";
  bool names_out = false;  ///< the command line does
  std::optional<std::filesystem::path> vehicle;
  std::optional<std::filesystem::path> policy;
  std::optional<std::filesystem::path> tables;
  std::optional<std::filesystem::path> public_key;
  std::optional<std::uint64_t> seed;
  host::PortOverride ports;
  double speed = 1.0;
  std::optional<double> speed_since;
  std::optional<std::uint32_t> simulation;
  std::uint64_t run = 0;
  std::uint32_t wait_s = 60;
  std::optional<std::filesystem::path> board;
  bool hear = false;
  bool snr_from_bus = false;
  bool replace = false;
  bool resume = false;
  std::vector<std::string> safety_copies;  ///< folders
  bool prove_no_alloc = false;
  bool check = false;
  std::optional<std::filesystem::path> chart;
  std::optional<std::string> journal_survives;
  std::optional<std::uint32_t> journal_part_mb;
  std::optional<std::uint32_t> journal_budget_mb;
  std::optional<std::string> log;

  [[nodiscard]] LogFormat log_format() const;
};

/// Names every option and what it is for.
void declare(program::CommandLine& line, Options& o);

/// @throws host::BadInput naming an option that does not go with another, or not with this build
void require_possible(const Options& o);

}  // namespace earshot::board
