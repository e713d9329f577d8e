#include "firmware/host/program/progress_bar.hpp"

#include <cstddef>
#include <utility>

#include "firmware/host/text/numbers.hpp"

namespace earshot::program {

ProgressBar::ProgressBar(std::string label) : label_(std::move(label)) {}

void ProgressBar::update(double fraction) {
  if (!line_.is_due() || !(fraction > 0.0)) return;
  constexpr double kWidth = 30.0;
  const auto filled = static_cast<std::size_t>(kWidth * fraction);
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  line_.draw(label_ + " [" + std::string(filled, '#') + std::string(static_cast<std::size_t>(kWidth) - filled, '.') +
             host::formatted("] %3.0f %%, %.0f s left", 100.0 * fraction, elapsed_s * (1.0 - fraction) / fraction));
}

}  // namespace earshot::program
