#include "sim/pe/sediment_points.hpp"

#include <cstddef>

namespace earshot::pe {

std::vector<SedimentPoint> sediment_points(const std::vector<ocean::SedimentLayer>& layers) {
  std::vector<SedimentPoint> points;
  double top = 0.0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const ocean::SedimentLayer& layer = layers[i];
    points.push_back({top, layer.sound_speed.value, layer.density_g_per_cm3, layer.attenuation_db_per_wavelength});
    if (i + 1 == layers.size()) break;
    top += layer.thickness.value;
    points.push_back({top, layer.sound_speed_at_base.value_or(layer.sound_speed).value,
                      layer.density_at_base_g_per_cm3.value_or(layer.density_g_per_cm3),
                      layer.attenuation_at_base_db_per_wavelength.value_or(layer.attenuation_db_per_wavelength)});
  }
  return points;
}

}  // namespace earshot::pe
