#include "sim/sonar/sonar_equation.hpp"

#include <cmath>

namespace earshot::sonar {

Result<Decibels> signal_to_noise(Decibels source_level, Decibels transmission_loss, Decibels noise_level) {
  const Decibels snr = source_level - transmission_loss - noise_level;
  if (!std::isfinite(snr.value)) return Status::kOutOfRange;
  return snr;
}

}  // namespace earshot::sonar
