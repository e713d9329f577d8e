#include "firmware/boards/linux/checklist/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/boards/linux/checklist/formatted.hpp"

namespace earshot::board {
namespace {

// Of the picture, in its own units.
constexpr double kLeft = 90;
constexpr double kTop = 60;
constexpr double kSide = 640;
constexpr double kLegendLeft = kLeft + kSide + 30;
constexpr double kWidth = kLegendLeft + 280;
constexpr double kHeight = kTop + kSide + 70;

constexpr const char* kInk = "#24303a";
constexpr const char* kFaint = "#8b98a3";

/// How one kind of place is drawn.
struct Style {
  const char* stroke;
  const char* fill;
  double width;
  const char* dashes;
};
constexpr Style kBox{"#24303a", "#e8eef3", 1.2, ""};
constexpr Style kWaypoints{"#5b6b78", "none", 1.0, "2 4"};
constexpr Style kInside{"#1b7f5c", "none", 2.0, ""};
constexpr Style kSave{"#c77700", "none", 2.0, "9 5"};
constexpr Style kHalt{"#b3261e", "none", 2.5, ""};
constexpr Style kZone{"#6a3d9a", "#d9c8ea", 1.5, ""};

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

std::vector<NorthEast> corners_of(const Rectangle& r) {
  return {r.south_west, {r.north_east.north, r.south_west.east}, r.north_east, {r.south_west.north, r.north_east.east}};
}

/// From metres north and east to places in the picture.
class Projection {
 public:
  explicit Projection(const config::Mission& mission) {
    include(corners_of(mission.operating_area));
    if (const auto& fence = mission.safety.fence) {
      for (const config::Polygon* tier : {&fence->inside, &fence->save, &fence->halt}) include(tier->span());
    }
    for (const config::Polygon& zone : mission.safety.no_surface) include(zone.span());
    if (mission.safety.safe_point) include(std::array{*mission.safety.safe_point});
    const double side_m = 1.08 * std::max(north_most_ - south_most_, east_most_ - west_most_);
    south_m_ = 0.5 * (south_most_ + north_most_ - side_m);
    west_m_ = 0.5 * (west_most_ + east_most_ - side_m);
    side_m_ = side_m;
  }

  [[nodiscard]] double x(double east_m) const { return kLeft + (east_m - west_m_) / side_m_ * kSide; }
  [[nodiscard]] double y(double north_m) const { return kTop + kSide - (north_m - south_m_) / side_m_ * kSide; }
  [[nodiscard]] double south_m() const { return south_m_; }
  [[nodiscard]] double west_m() const { return west_m_; }
  [[nodiscard]] double side_m() const { return side_m_; }

 private:
  void include(std::span<const NorthEast> places) {
    for (const NorthEast& place : places) {
      south_most_ = std::min(south_most_, place.north.value);
      north_most_ = std::max(north_most_, place.north.value);
      west_most_ = std::min(west_most_, place.east.value);
      east_most_ = std::max(east_most_, place.east.value);
    }
  }

  double south_most_ = std::numeric_limits<double>::infinity();
  double north_most_ = -std::numeric_limits<double>::infinity();
  double west_most_ = std::numeric_limits<double>::infinity();
  double east_most_ = -std::numeric_limits<double>::infinity();
  double south_m_ = 0.0;
  double west_m_ = 0.0;
  double side_m_ = 1.0;
};

std::string styled(const Style& style) {
  std::string text = formatted("fill=\"%s\" stroke=\"%s\" stroke-width=\"%.1f\"", style.fill, style.stroke, style.width);
  if (*style.dashes != '\0') text += formatted(" stroke-dasharray=\"%s\"", style.dashes);
  return text;
}

std::string polygon(std::span<const NorthEast> corners, const Projection& to, const Style& style) {
  std::string points;
  for (const NorthEast& corner : corners) points += formatted("%.2f,%.2f ", to.x(corner.east.value), to.y(corner.north.value));
  points.pop_back();
  return "<polygon points=\"" + points + "\" " + styled(style) + " stroke-linejoin=\"round\"/>\n";
}

std::string text_at(double x, double y, const std::string& text, const char* anchor, int size = 14, const char* colour = kInk) {
  return formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%d\" fill=\"%s\">", x, y, anchor, size, colour) +
         escaped(text) + "</text>\n";
}

/// 1, 2 or 5 times a power of ten, so that some four to eight of them fit.
double tick_of(double length_m) {
  const double rough = length_m / 8.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (rough <= step * power) return step * power;
  }
  return 10.0 * power;
}

std::string axes(const Projection& to) {
  std::string text = formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"white\" stroke=\"%s\"/>\n", kLeft, kTop,
                               kSide, kSide, kFaint);
  const double tick = tick_of(to.side_m());
  const int digits = tick >= 1000.0 ? 0 : tick >= 100.0 ? 1 : 2;
  for (double e = std::ceil(to.west_m() / tick) * tick; e <= to.west_m() + to.side_m(); e += tick) {
    text += formatted("<line x1=\"%.2f\" y1=\"%.1f\" x2=\"%.2f\" y2=\"%.1f\" stroke=\"%s\"/>\n", to.x(e), kTop + kSide, to.x(e),
                      kTop + kSide + 6, kFaint);
    text += text_at(to.x(e), kTop + kSide + 22, formatted("%.*f", digits, e * 1e-3 + 0.0), "middle");
  }
  for (double n = std::ceil(to.south_m() / tick) * tick; n <= to.south_m() + to.side_m(); n += tick) {
    text +=
        formatted("<line x1=\"%.1f\" y1=\"%.2f\" x2=\"%.1f\" y2=\"%.2f\" stroke=\"%s\"/>\n", kLeft - 6, to.y(n), kLeft, to.y(n), kFaint);
    text += text_at(kLeft - 10, to.y(n) + 5, formatted("%.*f", digits, n * 1e-3 + 0.0), "end");
  }
  text += text_at(kLeft + kSide / 2, kTop + kSide + 50, "km east of the origin", "middle");
  text += formatted("<text transform=\"translate(%.1f %.1f) rotate(-90)\" text-anchor=\"middle\" font-size=\"14\" fill=\"%s\">", kLeft - 58,
                    kTop + kSide / 2, kInk) +
          "km north of the origin</text>\n";
  return text;
}

/// Lines and words at the right of the chart, one below the other.
class Legend {
 public:
  void add(const Style& style, const std::string& words, const std::string& more = {}) {
    text_ += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"30\" height=\"16\" ", kLegendLeft, y_) + styled(style) + "/>\n";
    add_words(words, more);
  }
  void add_point(const std::string& words) {
    text_ += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"6\" fill=\"#0b57a4\" stroke=\"white\" stroke-width=\"2\"/>\n", kLegendLeft + 15,
                       y_ + 8);
    add_words(words, {});
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void add_words(const std::string& words, const std::string& more) {
    text_ += text_at(kLegendLeft + 42, y_ + 13, words, "start");
    if (!more.empty()) text_ += text_at(kLegendLeft + 42, y_ + 31, more, "start", 14, "#5b6b78");
    y_ += more.empty() ? 30 : 48;
  }

  std::string text_;
  double y_ = kTop + 6;
};

std::string point(NorthEast place, const Projection& to) {
  return formatted("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"6\" fill=\"#0b57a4\" stroke=\"white\" stroke-width=\"2\"/>\n",
                   to.x(place.east.value), to.y(place.north.value));
}

}  // namespace

std::string chart(const config::Mission& mission, const std::string& title) {
  const Projection to(mission);
  const config::Safety& safety = mission.safety;
  Legend legend;
  std::string drawn = axes(to) + polygon(corners_of(mission.operating_area), to, kBox);
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  legend.add(kBox, "search area", formatted("%.1f km x %.1f km", size.north.value * 1e-3, size.east.value * 1e-3));
  for (const config::Polygon& zone : safety.no_surface) drawn += polygon(zone.span(), to, kZone);
  if (mission.edge_margin.value > 0.0) {
    drawn += polygon(corners_of(mission.operating_area.moved_in(mission.edge_margin)), to, kWaypoints);
    legend.add(kWaypoints, "way-points", formatted("%.0f m from its edges", mission.edge_margin.value));
  }
  if (safety.fence) {
    drawn += polygon(safety.fence->inside.span(), to, kInside) + polygon(safety.fence->save.span(), to, kSave) +
             polygon(safety.fence->halt.span(), to, kHalt);
    const bool is_area = std::ranges::is_permutation(safety.fence->inside.span(), corners_of(mission.operating_area));
    legend.add(kInside, is_area ? "inside, on the area's edges" : "inside", "steered back until here");
    legend.add(kSave, "save", "steered back from here");
    legend.add(kHalt, "halt", "aborted from here");
  } else {
    drawn += polygon(corners_of(mission.operating_area), to, {kHalt.stroke, "none", kHalt.width, ""});
    legend.add(kHalt, "halt: no fence", "aborted beyond the search area");
  }
  if (!safety.no_surface.empty()) legend.add(kZone, "no surfacing", "but for an abort");
  if (safety.safe_point) {
    drawn += point(*safety.safe_point, to);
    legend.add_point("safe point");
  }
  return formatted(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
             "font-family=\"sans-serif\">\n",
             kWidth, kHeight, kWidth, kHeight) +
         formatted("<rect width=\"%.0f\" height=\"%.0f\" fill=\"white\"/>\n", kWidth, kHeight) +
         text_at(kLeft, kTop - 24, title, "start", 18) + drawn + legend.text() + "</svg>\n";
}

}  // namespace earshot::board
