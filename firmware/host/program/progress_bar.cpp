#include "firmware/host/program/progress_bar.hpp"

#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <utility>

#include "firmware/host/program/talk.hpp"

namespace earshot::program {

using namespace std::chrono_literals;

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) == 1 && program::talk() != program::Talk::kQuiet) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::update(double fraction) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - start_ < 1s || now - last_drawn_ < 100ms || !(fraction > 0.0)) return;
  constexpr double kWidth = 30.0;
  const auto filled = static_cast<std::size_t>(kWidth * fraction);
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string bar = std::string(filled, '#') + std::string(static_cast<std::size_t>(kWidth) - filled, '.');
  std::fprintf(stderr, "\r%s [%s] %3.0f %%, %.0f s left \033[K", label_.c_str(), bar.c_str(), 100.0 * fraction,
               elapsed_s * (1.0 - fraction) / fraction);
  std::fflush(stderr);
  last_drawn_ = now;
  drawn_ = true;
}

}  // namespace earshot::program
