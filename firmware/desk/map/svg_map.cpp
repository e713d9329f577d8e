#include "firmware/desk/map/svg_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "firmware/host/text/numbers.hpp"

namespace earshot::board {
namespace {

// Of the picture, in its own units.
constexpr double kLeft = 90;
constexpr double kTop = 60;
constexpr double kSide = 640;
constexpr double kLegendLeft = kLeft + kSide + 30;
constexpr double kWidth = kLegendLeft + 280;
constexpr double kHeight = kTop + kSide + 70;

constexpr const char* kFaint = "#8b98a3";

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

std::string styled(const SvgMap::Style& style) {
  std::string text = host::formatted("fill=\"%s\" stroke=\"%s\" stroke-width=\"%.1f\"", style.fill, style.stroke, style.width);
  if (*style.dashes != '\0') text += host::formatted(" stroke-dasharray=\"%s\"", style.dashes);
  return text;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor, int size = 14, const char* colour = SvgMap::kInk) {
  return host::formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%d\" fill=\"%s\">", x, y, anchor, size, colour) +
         escaped(text) + "</text>\n";
}

std::string circle(const std::string& place, const SvgMap::Dot& dot) {
  return "<circle " + place +
         host::formatted(" r=\"%g\" fill=\"%s\" stroke=\"%s\" stroke-width=\"%g\"/>\n", dot.radius, dot.fill, dot.stroke, dot.width);
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

}  // namespace

SvgMap::SvgMap(std::span<const NorthEast> shown, std::string title) : title_(std::move(title)), legend_y_(kTop + 6) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  NorthEast least{Meters{kInfinity}, Meters{kInfinity}};
  NorthEast most{Meters{-kInfinity}, Meters{-kInfinity}};
  for (const NorthEast& place : shown) {
    least = {std::min(least.north, place.north), std::min(least.east, place.east)};
    most = {std::max(most.north, place.north), std::max(most.east, place.east)};
  }
  side_m_ = 1.08 * std::max(most.north.value - least.north.value, most.east.value - least.east.value);
  south_m_ = 0.5 * (least.north.value + most.north.value - side_m_);
  west_m_ = 0.5 * (least.east.value + most.east.value - side_m_);
  drawn_ = axes();
}

Rectangle SvgMap::shown() const {
  return {{Meters{south_m_}, Meters{west_m_}}, {Meters{south_m_ + side_m_}, Meters{west_m_ + side_m_}}};
}

double SvgMap::x(double east_m) const {
  return kLeft + (east_m - west_m_) / side_m_ * kSide;
}

double SvgMap::y(double north_m) const {
  return kTop + kSide - (north_m - south_m_) / side_m_ * kSide;
}

std::string SvgMap::points(std::span<const NorthEast> places) const {
  std::string points;
  for (const NorthEast& place : places) points += host::formatted("%.2f,%.2f ", x(place.east.value), y(place.north.value));
  if (!points.empty()) points.pop_back();
  return points;
}

void SvgMap::polygon(std::span<const NorthEast> corners, const Style& style) {
  drawn_ += "<polygon points=\"" + points(corners) + "\" " + styled(style) + " stroke-linejoin=\"round\"/>\n";
}

void SvgMap::line(std::span<const NorthEast> places, const Style& style) {
  drawn_ += "<polyline points=\"" + points(places) + "\" " + styled(style) + " stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n";
}

void SvgMap::dot(NorthEast place, const Dot& dot) {
  drawn_ += circle(host::formatted("cx=\"%.2f\" cy=\"%.2f\"", x(place.east.value), y(place.north.value)), dot);
}

void SvgMap::words_at(NorthEast place, const std::string& words, const char* colour) {
  // Words in the right half of the map stand at the left of their place: they must not run over the legend.
  const double east = x(place.east.value);
  const bool is_left = east > kLeft + kSide / 2;
  const double y_of_words = y(place.north.value) - 14;
  const std::string begin =
      host::formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"15\" font-weight=\"bold\" fill=\"%s\" ",
                      east + (is_left ? -14 : 14), y_of_words, is_left ? "end" : "start", colour);
  drawn_ += begin + "stroke=\"white\" stroke-width=\"4\" paint-order=\"stroke\">" + escaped(words) + "</text>\n";
}

std::string SvgMap::axes() const {
  std::string text = host::formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"white\" stroke=\"%s\"/>\n", kLeft,
                                     kTop, kSide, kSide, kFaint);
  const double tick = tick_of(side_m_);
  const int digits = tick >= 1000.0 ? 0 : tick >= 100.0 ? 1 : 2;
  for (double e = std::ceil(west_m_ / tick) * tick; e <= west_m_ + side_m_; e += tick) {
    text += host::formatted("<line x1=\"%.2f\" y1=\"%.1f\" x2=\"%.2f\" y2=\"%.1f\" stroke=\"%s\"/>\n", x(e), kTop + kSide, x(e),
                            kTop + kSide + 6, kFaint);
    text += text_at(x(e), kTop + kSide + 22, host::formatted("%.*f", digits, e * 1e-3 + 0.0), "middle");
  }
  for (double n = std::ceil(south_m_ / tick) * tick; n <= south_m_ + side_m_; n += tick) {
    text +=
        host::formatted("<line x1=\"%.1f\" y1=\"%.2f\" x2=\"%.1f\" y2=\"%.2f\" stroke=\"%s\"/>\n", kLeft - 6, y(n), kLeft, y(n), kFaint);
    text += text_at(kLeft - 10, y(n) + 5, host::formatted("%.*f", digits, n * 1e-3 + 0.0), "end");
  }
  text += text_at(kLeft + kSide / 2, kTop + kSide + 50, "km east of the origin", "middle");
  text += host::formatted("<text transform=\"translate(%.1f %.1f) rotate(-90)\" text-anchor=\"middle\" font-size=\"14\" fill=\"%s\">",
                          kLeft - 58, kTop + kSide / 2, kInk) +
          "km north of the origin</text>\n";
  return text;
}

void SvgMap::legend(const Style& style, const std::string& words, const std::string& more) {
  legend_ += host::formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"30\" height=\"16\" ", kLegendLeft, legend_y_) + styled(style) + "/>\n";
  legend_words(words, more);
}

void SvgMap::legend_line(const Style& style, const std::string& words, const std::string& more) {
  legend_ += host::formatted("<polyline points=\"%.1f,%.1f %.1f,%.1f\" ", kLegendLeft, legend_y_ + 8, kLegendLeft + 30, legend_y_ + 8) +
             styled(style) + "/>\n";
  legend_words(words, more);
}

void SvgMap::legend(const Dot& dot, const std::string& words, const std::string& more) {
  legend_ += circle(host::formatted("cx=\"%.1f\" cy=\"%.1f\"", kLegendLeft + 15, legend_y_ + 8), dot);
  legend_words(words, more);
}

void SvgMap::legend_note(const std::string& words) {
  legend_ += text_at(kLegendLeft + 42, legend_y_ + 1, words, "start", 14, "#5b6b78");
  legend_y_ += 18;
}

void SvgMap::legend_words(const std::string& words, const std::string& more) {
  legend_ += text_at(kLegendLeft + 42, legend_y_ + 13, words, "start");
  if (!more.empty()) legend_ += text_at(kLegendLeft + 42, legend_y_ + 31, more, "start", 14, "#5b6b78");
  legend_y_ += more.empty() ? 30 : 48;
}

std::string SvgMap::svg() const {
  return host::formatted(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
             "font-family=\"sans-serif\">\n",
             kWidth, kHeight, kWidth, kHeight) +
         host::formatted("<rect width=\"%.0f\" height=\"%.0f\" fill=\"white\"/>\n", kWidth, kHeight) +
         text_at(kLeft, kTop - 24, title_, "start", 18) + drawn_ + legend_ + "</svg>\n";
}

std::vector<NorthEast> corners_of(const Rectangle& r) {
  return {r.south_west, {r.north_east.north, r.south_west.east}, r.north_east, {r.south_west.north, r.north_east.east}};
}

}  // namespace earshot::board
