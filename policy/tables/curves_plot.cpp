#include "policy/tables/curves_plot.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "firmware/host/file/printable.hpp"
#include "sim/plot/gnuplot.hpp"

namespace earshot::tables {
namespace {

constexpr std::size_t kMostInKey = 24;  // more names would cover the picture

std::string data_of(const policy::OceanTables& tables) {
  std::ostringstream data;
  for (std::size_t i = 0; i < tables.range_count; ++i) {
    data << static_cast<double>(i) * tables.range_step.value / 1000.0;
    for (const policy::OceanTable& table : tables.tables) data << ' ' << table.snr_db(i);
    data << '\n';
  }
  return data.str();
}

std::string curves_of(const policy::OceanTables& tables) {
  std::ostringstream text;
  float most = 0.0F;
  for (const policy::OceanTable& table : tables.tables) most = std::max(most, table.prior);
  const bool has_names = tables.tables.size() <= kMostInKey;
  for (std::size_t i = 0; i < tables.tables.size(); ++i) {
    const policy::OceanTable& table = tables.tables[i];
    const std::string name = host::printable({table.name.begin(), table.name.end()});
    text << (i == 0 ? "plot" : ",") << " $snr using 1:" << i + 2 << " with lines lw " << 0.5F + 2.0F * std::sqrt(table.prior / most) << ' '
         << (has_names ? "title " + plot::quoted(name) + " noenhanced" : "notitle");
  }
  return text.str() + ", 10 with lines dt (6,4) lc rgb 'black' title 'detection threshold'\n";
}

}  // namespace

void plot_curves(const std::filesystem::path& path, const policy::OceanTables& tables) {
  std::ostringstream title;
  title << tables.tables.size() << " oceans, " << tables.frequency.value << " Hz at " << tables.receiver_depth.value << " m";
  std::ostringstream text;
  text << "set title " << plot::quoted(title.str()) << " noenhanced\n"
       << "set xlabel 'range (km)'\nset ylabel 'SNR (dB)'\nset yrange [-20:64]\nset xrange [0:" << reach(tables).value / 1000.0 << "]\n"
       << "set tics out nomirror\nset grid lc rgb '#dddddd'\nset key outside right samplen 2\n$snr << EOD\n"
       << data_of(tables) << "EOD\n"
       << curves_of(tables);
  plot::draw(path, {.title = title.str(), .size = "1300,700", .commands = text.str()});
}

}  // namespace earshot::tables
