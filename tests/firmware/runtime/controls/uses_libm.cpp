// Positive control of the symbol check: it must be found out.
#include <cmath>

double bend(double x) {
  return std::tanh(x);
}
