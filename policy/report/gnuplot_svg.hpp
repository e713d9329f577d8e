#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"

namespace earshot::report {

/// A folder for gnuplot's input and output, gone with this object.
class PlotFolder {
 public:
  /// @throws std::runtime_error when no temporary folder can be made.
  PlotFolder();
  ~PlotFolder();
  PlotFolder(const PlotFolder&) = delete;
  PlotFolder& operator=(const PlotFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

/// A place as gnuplot reads it: kilometres east, kilometres north.
[[nodiscard]] std::string km(NorthEast place);

/// Grey text and no background: readable on a light page and on a dark one.
extern const char* const kPlotStyle;

/// Runs one gnuplot in the folder and returns what it drew as SVG text that may stand in a page.
/// @param script  sets its terminals and one output for each of `outputs`
/// @throws std::runtime_error when gnuplot is missing or fails.
[[nodiscard]] std::vector<std::string> svgs_from(const PlotFolder& folder, const std::string& script,
                                                 const std::vector<std::string>& outputs);

}  // namespace earshot::report
