#include "sim/sonar/gnuplot.hpp"

#include <cstdio>
#include <stdexcept>

namespace earshot::sonar {
namespace {

void run_gnuplot(const std::string& commands) {
  std::FILE* pipe = popen("gnuplot 2>&1 >/dev/null", "w");
  if (pipe == nullptr) throw std::runtime_error("gnuplot cannot be started");
  const bool written = std::fwrite(commands.data(), 1, commands.size(), pipe) == commands.size();
  if (pclose(pipe) != 0 || !written) throw std::runtime_error("gnuplot failed; is the Debian package gnuplot-nox installed?");
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

void draw(const std::filesystem::path& path, const std::string& size, const std::string& commands) {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".svg") throw std::invalid_argument(path.string() + ": a plot's name must end in .png or .svg");
  std::filesystem::path temporary = path;
  temporary += ".part";
  try {
    run_gnuplot("set terminal " + std::string(extension == ".png" ? "pngcairo" : "svg") + " size " + size + "\nset output " +
                quoted(temporary.string()) + "\n" + commands);
    std::filesystem::rename(temporary, path);
  } catch (const std::exception& e) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(path.string() + ": cannot be drawn: " + e.what());
  }
}

}  // namespace earshot::sonar
