#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace earshot::plot {

/// Whether `draw` can write a picture of that name: .png or .svg.
[[nodiscard]] bool is_picture_name(const std::filesystem::path& path);

struct Drawing {
  std::string title;     ///< what an SVG calls itself to a browser and to a screen reader
  std::string size;      ///< "width,height" in pixels
  std::string commands;  ///< what follows `set terminal` and `set output`
};

/// Draws with gnuplot under a temporary name, which takes its own when the picture is whole.
///
/// @param path  ends in .png or .svg
/// Throws std::invalid_argument for another extension, host::BadInput when the file cannot be made, std::runtime_error when gnuplot is
/// missing or fails.
void draw(const std::filesystem::path& path, const Drawing& drawing);

/// Runs gnuplot on the commands. Throws std::runtime_error when it is missing or fails.
void run_gnuplot(const std::string& commands);

/// A string for gnuplot, which expands nothing in it. Throws std::invalid_argument for a text of more than one line: the rest would be
/// commands.
[[nodiscard]] std::string quoted(const std::string& text);

/// A text as SVG and HTML want it.
[[nodiscard]] std::string escaped(std::string_view text);

/// gnuplot's SVG under a title of its own: gnuplot calls every picture "Gnuplot", which a browser shows over it.
[[nodiscard]] std::string with_title(std::string svg, std::string_view title);

}  // namespace earshot::plot
