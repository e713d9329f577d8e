#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hil/bus/candump/log_line.hpp"

namespace earshot::hil {

/// Reads a CSV of SavvyCAN (GVRET), line by line, by the names of its columns.
///
///   Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8
///   166064000,09F11223,true,Rx,0,8,FF,70,5A,FF,7F,FF,7F,FD,
///
/// Times are microseconds, since any beginning; bus 0 is can0.
/// Source: SavvyCAN, framefileio.cpp (what it writes).   Oracle: SavvyCanCsv tests
class SavvyCanReader {
 public:
  /// Whether a line is the names of its columns.
  [[nodiscard]] static bool knows(std::string_view line);
  [[nodiscard]] LineOr read(std::string_view line);

 private:
  std::vector<std::string> columns_;
};

}  // namespace earshot::hil
