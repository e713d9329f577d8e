#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/program/command_line.hpp"
#include "sim/listening/plan.hpp"

namespace earshot::listen {

/// What the command line of `earshot listen` says.
struct Arguments {
  std::vector<std::string> files;  ///< or folders
  std::string begin;               ///< of the only file; empty: as the file says
  std::string time_format;         ///< of the files' names; empty: as the files say
  std::string preset = "fin";
  std::vector<double> band_hz;  ///< low and high, or nothing
  std::optional<double> threshold_db;
  std::size_t channel = 1;
  std::string calibration;
  std::optional<double> full_scale_level_db;
  std::string csv;
  std::string raven;
  std::string json;
  std::string spectrogram;
  std::string levels;
  double levels_interval_s = 60.0;
  std::string truth;
  double tolerance_s = 2.0;
  std::string roc;
  bool force = false;   ///< replace files that are of another kind
  std::string history;  ///< the command itself
};

void describe(program::CommandLine& line, Arguments& arguments);

/// In place of each folder its recordings. Throws host::BadInput.
void open_folders(Arguments& arguments);

/// Refuses outputs that cannot be written, are named twice or are one of the files that are read, before the work and not after it. Throws
/// host::BadInput.
void require_writable(const Arguments& arguments);

/// What is asked of the recording. Throws host::BadInput where the calibration is none.
[[nodiscard]] listening::Request request_of(const Arguments& arguments);

}  // namespace earshot::listen
