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

/// gnuplot's commands for axes over an area, in kilometres.
[[nodiscard]] std::string km_ranges(const Rectangle& area);

/// A colour for gnuplot that becomes the page's ink: dark on a light page and on paper, light on a dark one.
inline constexpr const char* kInk = "rgb '#010203'";

/// gnuplot's commands for an SVG that stands in a page: no background; border, text and legend in the page's ink, large enough to be read
/// on a telephone.
/// @param size  "width,height" in pixels; a width of 600 leaves letters of 9 pixels on a screen of 390
[[nodiscard]] std::string page_style(const std::string& size);

struct SvgOutput {
  std::string file;   ///< in the folder
  std::string title;  ///< what it calls itself to a browser and to a screen reader
};

/// Runs one gnuplot in the folder and returns what it drew as SVG text that may stand in a page.
/// @param script  sets its terminals and one output for each of `outputs`
/// @throws std::runtime_error when gnuplot is missing or fails.
[[nodiscard]] std::vector<std::string> svgs_from(const PlotFolder& folder, const std::string& script,
                                                 const std::vector<SvgOutput>& outputs);

}  // namespace earshot::report
