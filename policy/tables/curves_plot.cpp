#include "policy/tables/curves_plot.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "firmware/host/file/printable.hpp"
#include "policy/tables/description.hpp"
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

std::string title_of(const policy::OceanTable& table) {
  return "title " + plot::quoted(host::printable({table.name.begin(), table.name.end()})) + " noenhanced";
}

/// One colour each, by name.
std::string few_curves(const policy::OceanTables& tables, float most) {
  std::ostringstream text;
  for (std::size_t i = 0; i < tables.tables.size(); ++i) {
    const policy::OceanTable& table = tables.tables[i];
    text << " $snr using 1:" << i + 2 << " with lines lw " << 0.5F + 2.0F * std::sqrt(table.prior / most) << ' ' << title_of(table) << ',';
  }
  return text.str();
}

/// Coloured by the depth of the sea floor; over them, by name, what is likelier than all others together or as likely.
std::string many_curves(const policy::OceanTables& tables) {
  float half = 0.0F;
  for (const policy::OceanTable& table : tables.tables) half += 0.4999F * table.prior;  // a little less: priors are rounded
  std::ostringstream text;
  std::ostringstream likeliest;
  for (std::size_t i = 0; i < tables.tables.size(); ++i) {
    const policy::OceanTable& table = tables.tables[i];
    text << " $snr using 1:" << i + 2 << " with lines lc palette cb " << table.sea_depth_m << " notitle,";
    if (table.prior >= half) likeliest << " $snr using 1:" << i + 2 << " with lines lw 3 lc rgb 'black' " << title_of(table) << ',';
  }
  return text.str() + likeliest.str();
}

std::string curves_of(const policy::OceanTables& tables) {
  constexpr auto kPrior = &policy::OceanTable::prior;
  constexpr auto kDepth = &policy::OceanTable::sea_depth_m;
  std::ostringstream text;
  if (tables.tables.size() <= kMostInKey) {
    text << "set key outside right samplen 2\nplot" << few_curves(tables, std::ranges::max_element(tables.tables, {}, kPrior)->prior);
  } else {
    const auto [least, most] = std::ranges::minmax_element(tables.tables, {}, kDepth);
    text << "set palette defined (0 '#c77d2b', 0.5 '#3f8fc5', 1 '#10204a')\nset logscale cb\nset cbtics (30, 50, 100, 200, 300, 500, 1000, "
            "2000, 3000, 5000)\n"
         << "set cblabel 'sea floor (m)'\nset cbrange [" << 0.9F * least->sea_depth_m << ":" << 1.1F * most->sea_depth_m << "]\n"
         << "set key above\nplot" << many_curves(tables);
  }
  text << " 10 with lines dt (6,4) lc rgb 'black' title 'detection threshold'\n";
  return text.str();
}

}  // namespace

void plot_curves(const std::filesystem::path& path, const policy::OceanTables& tables) {
  std::ostringstream title;
  title << tables.tables.size() << " ocean tables: SNR of " << tables.frequency.value << " Hz, vehicle at " << tables.receiver_depth.value
        << " m, sources at " << from_to(tables.source_depth);
  std::ostringstream text;
  text << "set title " << plot::quoted(title.str()) << " noenhanced\n"
       << "set xlabel 'range (km)'\nset ylabel 'SNR (dB)'\nset yrange [-20:64]\nset xrange [0:"
       << std::max(reach(tables), tables.range_step).value / 1000.0 << "]\n"
       << "set tics out nomirror\nset grid lc rgb '#dddddd'\n$snr << EOD\n"
       << data_of(tables) << "EOD\n"
       << curves_of(tables);
  plot::draw(path, {.title = title.str(), .size = "1300,700", .commands = text.str()});
}

}  // namespace earshot::tables
