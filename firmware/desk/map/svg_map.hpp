#pragma once

#include <span>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"

namespace earshot::board {

/// A map of a piece of the mission's plane as an SVG picture: north is up, axes in kilometres, a legend at its right. What is drawn later
/// lies above.
class SvgMap {
 public:
  /// How one kind of place is drawn.
  struct Style {
    const char* stroke;
    const char* fill;
    double width;
    const char* dashes;
  };
  struct Dot {
    const char* fill;
    const char* stroke;
    double radius;
    double width;
  };

  static constexpr const char* kInk = "#24303a";

  /// @param shown  all that must be on the map, at least two places that are not the same
  /// @param title  above it, in UTF-8
  SvgMap(std::span<const NorthEast> shown, std::string title);

  /// All that lies within the axes.
  [[nodiscard]] Rectangle shown() const;

  void polygon(std::span<const NorthEast> corners, const Style& style);
  void line(std::span<const NorthEast> places, const Style& style);
  void dot(NorthEast place, const Dot& dot);
  /// Words that begin beside a place.
  void words_at(NorthEast place, const std::string& words, const char* colour);

  void legend(const Style& style, const std::string& words, const std::string& more = {});
  void legend_line(const Style& style, const std::string& words, const std::string& more = {});
  void legend(const Dot& dot, const std::string& words, const std::string& more = {});
  /// Words that belong to what stands above them.
  void legend_note(const std::string& words);

  [[nodiscard]] std::string svg() const;

 private:
  [[nodiscard]] double x(double east_m) const;
  [[nodiscard]] double y(double north_m) const;
  [[nodiscard]] std::string points(std::span<const NorthEast> places) const;
  [[nodiscard]] std::string axes() const;
  void legend_words(const std::string& words, const std::string& more);

  std::string title_;
  double south_m_ = 0.0;
  double west_m_ = 0.0;
  double side_m_ = 1.0;
  std::string drawn_;
  std::string legend_;
  double legend_y_;
};

/// From the south-west corner on.
[[nodiscard]] std::vector<NorthEast> corners_of(const Rectangle& rectangle);

}  // namespace earshot::board
