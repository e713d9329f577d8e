#include "firmware/host/program/progress_bar.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace earshot::program {

ProgressBar::ProgressBar(std::string label) : label_(std::move(label)) {}

void ProgressBar::update(double fraction) {
  if (!line_.is_due() || !(fraction > 0.0)) return;
  constexpr double kWidth = 30.0;
  const auto filled = static_cast<std::size_t>(kWidth * fraction);
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::array<char, 64> numbers{};
  (void)std::snprintf(numbers.data(), numbers.size(), "] %3.0f %%, %.0f s left", 100.0 * fraction, elapsed_s * (1.0 - fraction) / fraction);
  line_.draw(label_ + " [" + std::string(filled, '#') + std::string(static_cast<std::size_t>(kWidth) - filled, '.') + numbers.data());
}

}  // namespace earshot::program
