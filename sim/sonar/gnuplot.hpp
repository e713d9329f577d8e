#pragma once

#include <filesystem>
#include <string>

namespace earshot::sonar {

/// Whether `draw` can write a picture of that name: .png or .svg.
[[nodiscard]] bool is_picture_name(const std::filesystem::path& path);

/// Draws with gnuplot under a temporary name, which takes its own when the picture is whole.
///
/// @param path      ends in .png or .svg
/// @param size      "width,height" in pixels
/// @param commands  what follows `set terminal` and `set output`
/// Throws std::invalid_argument for another extension, std::runtime_error when gnuplot is missing or fails.
void draw(const std::filesystem::path& path, const std::string& size, const std::string& commands);

/// Runs gnuplot on the commands. Throws std::runtime_error when it is missing or fails.
void run_gnuplot(const std::string& commands);

/// A string for gnuplot, which expands nothing in it. Throws std::invalid_argument for a text of more than one line: the rest would be
/// commands.
[[nodiscard]] std::string quoted(const std::string& text);

}  // namespace earshot::sonar
