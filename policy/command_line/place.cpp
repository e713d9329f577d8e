#include "policy/command_line/place.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/command_line.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::command_line {
namespace {

using host::BadInput;

struct Length {
  Meters length;
  bool has_unit;
};

/// "10000", "10000m" or "10km".
std::optional<Length> length_in(std::string text) {
  const auto ends = [&text](std::string_view unit) { return text.ends_with(unit); };
  const double scale = ends("km") ? 1000.0 : 1.0;
  const std::size_t unit = ends("km") ? 2 : ends("m") ? 1 : 0;
  text.resize(text.size() - unit);
  const std::optional<double> number = program::finite_number(text);
  if (!number) return std::nullopt;
  return Length{Meters{scale * *number}, unit > 0};
}

}  // namespace

NorthEast north_east_of(const std::string& option, const std::string& text) {
  const std::size_t comma = text.find(',');
  const std::optional<Length> north = length_in(text.substr(0, comma));
  const std::optional<Length> east = comma == std::string::npos ? std::nullopt : length_in(text.substr(comma + 1));
  if (!north || !east)
    throw BadInput(option + " " + text + ": two lengths are needed, metres north and metres east, such as 10000,10000 or 10km,10km");
  constexpr double kProbablyKilometres = 100.0;
  const NorthEast place{north->length, east->length};
  const double further = std::max(std::abs(place.north.value), std::abs(place.east.value));
  if (north->has_unit || east->has_unit || further == 0.0 || further >= kProbablyKilometres) return place;
  throw BadInput(option + " " + text + ": " +
                 host::formatted("metres are meant: did you mean %.10g,%.10g (or %.10gkm,%.10gkm)? If not, write %.10gm,%.10gm",
                                 1000.0 * place.north.value, 1000.0 * place.east.value, place.north.value, place.east.value,
                                 place.north.value, place.east.value));
}

}  // namespace earshot::command_line
