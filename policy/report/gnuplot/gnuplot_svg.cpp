#include "policy/report/gnuplot/gnuplot_svg.hpp"

#include <unistd.h>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "sim/plot/gnuplot.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// gnuplot writes kInk in these two ways; a page's style says what --ink is. With a font of 16 its symbols are hair lines, whatever the
/// line width.
void suit_page(std::string& svg) {
  for (const char* ink : {"rgb(1,2,3)", "rgb(  1,   2,   3)"}) replace_all(svg, ink, "var(--ink, #1d2733)");
  replace_all(svg, "stroke-width='0.167'", "stroke-width='0.4'");
}

}  // namespace

std::string km(NorthEast place) {
  std::ostringstream text;
  text << place.east.value / 1e3 << ' ' << place.north.value / 1e3;
  return text.str();
}

std::string km_ranges(const Rectangle& area) {
  std::ostringstream text;
  text << "set xrange [" << area.south_west.east.value / 1e3 << ':' << area.north_east.east.value / 1e3 << "]\nset yrange ["
       << area.south_west.north.value / 1e3 << ':' << area.north_east.north.value / 1e3 << "]\n";
  return text.str();
}

std::string page_style(const std::string& size) {
  std::string text = "set encoding utf8\nset terminal svg size " + size + " dynamic enhanced font 'sans-serif,16'\nset border lc " + kInk +
                     "\nset key reverse Left samplen 2\n";
  for (const char* labelled : {"tics", "xlabel", "ylabel", "cblabel", "cbtics", "key", "title"})
    text += std::string("set ") + labelled + " textcolor " + kInk + "\n";
  return text;
}

PlotFolder::PlotFolder() {
  std::error_code unusable;
  const fs::path parent = fs::temp_directory_path(unusable);
  if (unusable) {
    const char* variable = std::getenv("TMPDIR");
    throw std::runtime_error(std::string("no temporary folder can be made: TMPDIR = ") + (variable != nullptr ? variable : "/tmp") +
                             ": must be a folder that may be written");
  }
  std::string name = (parent / "earshot-report-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made in " + parent.string());
  folder_ = name;
}

PlotFolder::~PlotFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<std::string> svgs_from(const PlotFolder& folder, const std::string& script, const std::vector<SvgOutput>& outputs) {
  plot::run_gnuplot("cd " + plot::quoted(folder.path().string()) + "\n" + script);
  std::vector<std::string> svgs;
  for (const SvgOutput& output : outputs) {
    const std::string text = content(folder / output.file);
    const std::size_t root = text.find("<svg");
    if (root == std::string::npos) throw std::runtime_error("gnuplot drew nothing; is the disk full?");
    svgs.push_back(plot::with_title(text.substr(root), output.title));
    suit_page(svgs.back());
  }
  return svgs;
}

}  // namespace earshot::report
