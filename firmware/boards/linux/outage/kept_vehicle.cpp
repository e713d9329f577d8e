#include "firmware/boards/linux/outage/kept_vehicle.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>

#include "firmware/config/capacities.hpp"
#include "firmware/host/safety_record/record_file.hpp"

namespace earshot::board {
namespace {

constexpr std::uint32_t kFormat = 1;

/// Text that ends with a zero.
template <std::size_t kSize>
bool put(const std::string& text, std::array<char, kSize>& into) {
  if (text.size() >= kSize) return false;
  std::ranges::copy(text, into.begin());
  return true;
}

struct KeptPort {
  std::array<char, 64> name{};
  std::array<char, 256> address{};
  host::PortKind kind = host::PortKind::kLcm;
  host::Roles roles;
  host::N2kSettings n2k;
};

struct Kept {
  std::uint32_t format = kFormat;
  std::uint32_t size = sizeof(Kept);  ///< another build's is another, or nearly always
  config::Mission mission;
  Duration step_period;
  n2k::LocalPlane plane;
  std::size_t ports = 0;
  std::array<KeptPort, config::kMaxPorts> port{};
};
static_assert(std::is_trivially_copyable_v<Kept>);
static_assert(sizeof(Kept) <= host::kMostKeptBytes - sizeof(std::uint32_t));

}  // namespace

std::vector<std::uint8_t> kept_vehicle(const host::MissionFile& file) {
  // Zeros between the members: the same mission is the same bytes.
  std::vector<std::uint8_t> bytes(sizeof(Kept));
  const auto kept = std::make_unique<Kept>();
  kept->mission = file.mission;
  kept->step_period = file.step_period;
  kept->plane = file.plane;
  for (const host::PortSettings& port : file.ports) {
    if (port.roles.has(host::Role::kHydrophone)) continue;
    if (kept->ports == kept->port.size()) return {};
    KeptPort& into = kept->port[kept->ports++];
    if (!put(port.name, into.name) || !put(port.address, into.address)) return {};
    into.kind = port.kind;
    into.roles = port.roles;
    into.n2k = port.n2k;
  }
  std::memcpy(bytes.data(), kept.get(), sizeof(Kept));
  return bytes;
}

std::optional<host::MissionFile> vehicle_of(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != sizeof(Kept)) return std::nullopt;
  const auto kept = std::make_unique<Kept>();
  std::memcpy(kept.get(), bytes.data(), sizeof(Kept));
  if (kept->format != kFormat || kept->size != sizeof(Kept) || kept->ports > kept->port.size()) return std::nullopt;
  host::MissionFile file;
  file.mission = kept->mission;
  file.step_period = kept->step_period;
  file.plane = kept->plane;
  for (const KeptPort& port : std::span(kept->port).first(kept->ports)) {
    host::PortSettings& settings = file.ports.emplace_back();
    settings.name = port.name.data();
    settings.address = port.address.data();
    settings.kind = port.kind;
    settings.roles = port.roles;
    settings.n2k = port.n2k;
  }
  return file;
}

}  // namespace earshot::board
