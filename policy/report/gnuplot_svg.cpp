#include "policy/report/gnuplot_svg.hpp"

#include <unistd.h>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "sim/sonar/gnuplot.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::string km(NorthEast place) {
  std::ostringstream text;
  text << place.east.value / 1e3 << ' ' << place.north.value / 1e3;
  return text.str();
}

const char* const kPlotStyle = R"(
set border lc rgb '#888888'
set tics textcolor rgb '#888888'
set xlabel textcolor rgb '#888888'
set ylabel textcolor rgb '#888888'
set y2label textcolor rgb '#888888'
set key textcolor rgb '#888888'
)";

PlotFolder::PlotFolder() {
  std::string name = (fs::temp_directory_path() / "earshot-report-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made in " + fs::temp_directory_path().string());
  folder_ = name;
}

PlotFolder::~PlotFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<std::string> svgs_from(const PlotFolder& folder, const std::string& script, const std::vector<std::string>& outputs) {
  sonar::run_gnuplot("cd " + sonar::quoted(folder.path().string()) + "\n" + script);
  std::vector<std::string> svgs;
  for (const std::string& output : outputs) {
    const std::string text = content(folder / output);
    const std::size_t root = text.find("<svg");
    if (root == std::string::npos) throw std::runtime_error("gnuplot drew nothing; is the disk full?");
    svgs.push_back(text.substr(root));
  }
  return svgs;
}

}  // namespace earshot::report
