#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace earshot::reference {

/// Transmission loss in dB re 1 m against range in m.
using TransmissionLoss = std::map<int, double>;

/// One column of a case's tl.csv; column 0 is the first after range_m.
inline TransmissionLoss load(const std::string& case_name, int column = 0) {
  const std::string path = std::string(EARSHOT_SOURCE_DIR) + "/tests/reference/pe/" + case_name + "/tl.csv";
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path);
  TransmissionLoss loss;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string range;
    std::string value;
    std::getline(cells, range, ',');
    for (int i = 0; i <= column; ++i) std::getline(cells, value, ',');
    loss[static_cast<int>(std::lround(std::stod(range)))] = std::stod(value);
  }
  return loss;
}

struct Difference {
  double root_mean_square_db = 0.0;
  double mean_db = 0.0;  ///< of |difference|
  int count = 0;
};

/// Which ranges count: from lowest to highest, where `skip(range, reference loss)` is false.
template <class Skip>
Difference compare(const TransmissionLoss& computed, const TransmissionLoss& truth, int lowest_m, int highest_m, Skip skip) {
  Difference result;
  for (const auto& [range_m, loss_db] : computed) {
    const auto expected = truth.find(range_m);
    if (range_m < lowest_m || range_m > highest_m || expected == truth.end() || skip(range_m, expected->second)) continue;
    const double difference_db = loss_db - expected->second;
    result.mean_db += std::abs(difference_db);
    result.root_mean_square_db += difference_db * difference_db;
    ++result.count;
  }
  result.mean_db /= std::max(1, result.count);
  result.root_mean_square_db = std::sqrt(result.root_mean_square_db / std::max(1, result.count));
  return result;
}

/// True where the reference lies more than 10 dB below its own power mean within +-window_m: interference minima, as in each case's
/// tolerance_db.
class DeepMinimum {
 public:
  DeepMinimum(const TransmissionLoss& truth, int window_m) : truth_(truth), window_m_(window_m) {}
  bool operator()(int range_m, double loss_db) const {
    double power = 0.0;
    int count = 0;
    for (auto i = truth_.lower_bound(range_m - window_m_); i != truth_.end() && i->first <= range_m + window_m_; ++i, ++count) {
      power += std::pow(10.0, -i->second / 10.0);
    }
    return loss_db > -10.0 * std::log10(power / count) + 10.0;
  }

 private:
  const TransmissionLoss& truth_;
  int window_m_;
};

}  // namespace earshot::reference
