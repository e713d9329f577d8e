#include "policy/report/map/kilometres.hpp"

#include <sstream>

namespace earshot::report {

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

}  // namespace earshot::report
