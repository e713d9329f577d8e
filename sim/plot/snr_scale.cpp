#include "sim/plot/snr_scale.hpp"

#include <sstream>

namespace earshot::plot {

std::string snr_scale(Decibels detection_threshold) {
  const double threshold = detection_threshold.value;
  std::ostringstream text;
  text << "set cblabel 'SNR (dB)' offset 1,0\nset cbrange [" << threshold - 20.0 << ':' << threshold + 30.0 << "]\nset cbtics 10\n"
       << "set palette defined (0 '#081d58', 20 '#bdd7e7', 20 '#fff3b0', 50 '#a63603')\n";
  return text.str();
}

}  // namespace earshot::plot
