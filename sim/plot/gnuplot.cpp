#include "sim/plot/gnuplot.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <ios>
#include <iterator>
#include <stdexcept>

#include "firmware/host/file/output_file.hpp"

namespace earshot::plot {
namespace {

/// A gnuplot that ends early must not end us.
class BrokenPipeIgnored {
 public:
  BrokenPipeIgnored() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~BrokenPipeIgnored() { (void)std::signal(SIGPIPE, before_); }
  BrokenPipeIgnored(const BrokenPipeIgnored&) = delete;
  BrokenPipeIgnored& operator=(const BrokenPipeIgnored&) = delete;

 private:
  void (*before_)(int);
};

/// gnuplot does not notice that a disk was full, and reports success.
void require_whole(const std::filesystem::path& picture, const std::string& mark) {
  std::string tail(16, ' ');
  std::ifstream stream(picture, std::ios::binary);
  stream.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  stream.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  if (tail.find(mark) == std::string::npos) throw std::runtime_error("gnuplot left it unfinished; is the disk full?");
}

void retitle(const std::filesystem::path& svg, const std::string& title) {
  std::ifstream stream(svg);
  const std::string text = with_title({std::istreambuf_iterator<char>(stream), {}}, title);
  if (!(std::ofstream(svg) << text).flush()) throw std::runtime_error("it cannot be written; is the disk full?");
}

}  // namespace

std::string quoted(const std::string& text) {
  if (text.find_first_of(std::string("\n\r\0", 3)) != std::string::npos)
    throw std::invalid_argument("a line break cannot stand in a text for gnuplot");
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

std::string with_title(std::string svg, std::string_view title) {
  constexpr std::string_view kGnuplots = "<title>Gnuplot</title>";
  const std::size_t at = svg.find(kGnuplots);
  if (at != std::string::npos) svg.replace(at, kGnuplots.size(), "<title>" + escaped(title) + "</title>");
  return svg;
}

void run_gnuplot(const std::string& commands) {
  const BrokenPipeIgnored ignored;
  std::FILE* pipe = popen("gnuplot >/dev/null 2>&1", "w");
  if (pipe == nullptr) throw std::runtime_error("gnuplot cannot be started");
  const bool written = std::fwrite(commands.data(), 1, commands.size(), pipe) == commands.size() && std::fflush(pipe) == 0;
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw std::runtime_error("gnuplot is not there; install the Debian package gnuplot-nox");
  }
  if (status != 0 || !written) throw std::runtime_error("gnuplot failed; is the disk full?");
}

bool is_picture_name(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  return extension == ".png" || extension == ".svg";
}

void draw(const std::filesystem::path& path, const Drawing& drawing) {
  if (!is_picture_name(path)) throw std::invalid_argument(path.string() + ": a plot's name must end in .png or .svg");
  const bool png = path.extension() == ".png";
  // Its other name is absolute: gnuplot takes one that begins with | for a command.
  host::OutputFile picture(path);
  try {
    run_gnuplot(std::string("set encoding utf8\nset terminal ") + (png ? "pngcairo" : "svg background rgb 'white'") +
                " font 'Sans,12' size " + drawing.size + "\nset output " + quoted(picture.partial().string()) + "\n" + drawing.commands +
                "\nset output\n");
    require_whole(picture.partial(), png ? "IEND" : "</svg>");
    if (!png) retitle(picture.partial(), drawing.title);
    picture.commit(host::OutputFile::Survives::kProcess);
  } catch (const std::exception& e) {
    throw std::runtime_error(path.string() + ": cannot be drawn: " + e.what());
  }
}

}  // namespace earshot::plot
