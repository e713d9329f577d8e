#include "firmware/host/mission/n2k_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "firmware/wire/n2k/node/address_claim.hpp"

namespace earshot::host {
namespace {

using n2k::Measured;

constexpr double kShortest_s = 1e-6;  // less would be rounded to nothing
constexpr std::int64_t kMostUniqueNumber = (1 << 21) - 1;

constexpr const char* kOldestPart = "oldest_part_s";
constexpr const char* kPressure = "pressure";
constexpr const char* kZero = "zero_pressure_at_surface";
constexpr std::array kNavigationKeys{kOldestPart, kPressure, kZero};

/// A quantity whose device a mission may name.
struct Quantity {
  const char* key;
  Measured measured;
  bool has_instance = false;  ///< whether its messages bear one
};
constexpr std::array kQuantities{Quantity{"position", Measured::kPosition},    Quantity{"heading", Measured::kHeading},
                                 Quantity{"variation", Measured::kVariation},  Quantity{"speed", Measured::kSpeed},
                                 Quantity{"depth", Measured::kPressure, true}, Quantity{"altitude", Measured::kAltitude},
                                 Quantity{"battery", Measured::kCharge, true}};

/// "0xC0328600D0E4F1A2"; nothing if it is no NAME.
std::optional<n2k::Name> name_in(std::string_view text) {
  if (!text.starts_with("0x")) return std::nullopt;
  text.remove_prefix(2);
  n2k::Name name = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), name, 16);
  if (error != std::errc{} || end != text.data() + text.size() || name == 0) return std::nullopt;
  return name;
}

/// @param has_instance  whether the messages of the quantity bear one
n2k::SourceChoice read_source(TableReader sources, const char* key, bool has_instance) {
  std::optional<TableReader> table = sources.optional_table(key);
  if (!table) return {};
  n2k::SourceChoice choice;
  if (table->has("name")) {
    const std::string text = table->text("name");
    choice.name = name_in(text);
    if (!choice.name && !table->is_noted("name"))
      table->problem("name", "must be a device's NAME, 64 bits in hexadecimal: \"0x\" and 1 to 16 digits, not all zero");
  }
  if (table->has("instance")) {
    choice.instance = static_cast<std::uint8_t>(table->integer("instance", 0, 252));
    if (!has_instance) table->problem("instance", "only messages of depth (pressure) and battery bear an instance: give the device's name");
  }
  if (!table->has("name") && !table->has("instance"))
    sources.problem(key, has_instance ? "must give a device's name, an instance, or both" : "must give a device's name");
  return choice;
}

void read_sources(TableReader sources, Roles roles, N2kSettings& settings) {
  for (const auto& [key, measured, has_instance] : kQuantities) {
    settings.navigation.sensors.sources[static_cast<std::size_t>(measured)] = read_source(sources, key, has_instance);
    if (sources.has(key) && !roles.has(Role::kNavigation)) sources.problem(key, "of use only to a port with the role \"navigation\"");
  }
  settings.snr_source = read_source(sources, "snr", false);
  if (sources.has("snr") && !roles.has(Role::kSnr)) sources.problem("snr", "of use only to a port with the role \"snr\"");
  settings.autopilot_source = read_source(sources, "autopilot", false);
  if (sources.has("autopilot") && !roles.has(Role::kAutopilot))
    sources.problem("autopilot", "of use only to a port with the role \"autopilot\"");
}

void read_pressure(TableReader& table, N2kSettings& settings) {
  const bool is_absolute = table.choice_or(kPressure, 0, {"gauge", "absolute"}) == 1;
  settings.navigation.sensors.pressure_kind = is_absolute ? n2k::PressureKind::kAbsolute : n2k::PressureKind::kGauge;
  settings.zero_pressure_at_surface = table.boolean_or(kZero, false);
  if (is_absolute && !settings.zero_pressure_at_surface && !table.is_noted(kZero))
    table.problem(kZero, "must be true with an absolute pressure, which gives no depth before the air's is known");
}

}  // namespace

N2kSettings default_n2k(Duration navigation_timeout) {
  N2kSettings settings;
  settings.navigation.oldest_part = std::min(settings.navigation.oldest_part, navigation_timeout);
  return settings;
}

N2kSettings read_n2k(std::optional<TableReader> table, Roles roles, Duration navigation_timeout) {
  N2kSettings settings = default_n2k(navigation_timeout);
  if (!table) return settings;
  settings.address = static_cast<std::uint8_t>(table->integer_or("address", settings.address, 0, n2k::kLastAddress));
  settings.unique_number = static_cast<std::uint32_t>(table->integer_or("unique_number", settings.unique_number, 0, kMostUniqueNumber));
  settings.device_instance = static_cast<std::uint8_t>(table->integer_or("device_instance", settings.device_instance, 0, 255));
  const double oldest_s = table->number_or(kOldestPart, settings.navigation.oldest_part.to_seconds(),
                                           Range::between(kShortest_s, navigation_timeout.to_seconds()));
  settings.navigation.oldest_part = {std::llround(oldest_s * 1e6)};
  read_pressure(*table, settings);
  for (const char* key : kNavigationKeys) {
    if (table->has(key) && !roles.has(Role::kNavigation)) table->problem(key, "of use only to a port with the role \"navigation\"");
  }
  if (const std::optional<TableReader> sources = table->optional_table("sources")) read_sources(*sources, roles, settings);
  return settings;
}

}  // namespace earshot::host
