#include "hil/bench/at_sea/kernel_counts.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace earshot::hil {
namespace {

using nlohmann::json;

constexpr const char* kPath = "PATH=/usr/sbin:/usr/bin:/sbin:/bin; ";  // where no shell of a user looks, iproute2 may be

/// @param command  for a shell: no word of it may be a stranger's   @return what it printed; discarded where it is no JSON
json printed_by(const std::string& command) {
  const auto close = [](std::FILE* pipe) { (void)::pclose(pipe); };
  const std::unique_ptr<std::FILE, decltype(close)> pipe(::popen((kPath + command + " 2>/dev/null").c_str(), "r"), close);
  std::string text;
  std::array<char, 4096> piece{};
  while (pipe && !std::feof(pipe.get()) && !std::ferror(pipe.get()))
    text.append(piece.data(), std::fread(piece.data(), 1, piece.size(), pipe.get()));
  return json::parse(text, nullptr, false);
}

/// Of the first object of an array; null where there is none.
json first_of(const json& all) {
  return all.is_array() && !all.empty() ? all.front() : json();
}

/// An interface's name may hold what a shell takes for its own.
std::string quoted(const std::string& interface) {
  std::string text = "'";
  for (const char character : interface) text += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return text + "'";
}

}  // namespace

std::optional<ControllerCounts> controller_counts(const std::string& interface) {
  const json link = first_of(printed_by("ip -json -statistics -details link show dev " + quoted(interface)));
  const json::json_pointer counts("/linkinfo/info_xstats");
  if (!link.contains(counts)) return std::nullopt;
  return ControllerCounts{.error_passive = link.at(counts).value("error_passive", std::uint64_t{0}),
                          .bus_off = link.at(counts).value("bus_off", std::uint64_t{0})};
}

std::optional<NetemCounts> netem_counts(const std::string& interface) {
  const json queue = first_of(printed_by("tc -json -statistics qdisc show dev " + quoted(interface) + " root"));
  if (!queue.is_object() || queue.value("kind", "") != "netem") return std::nullopt;
  return NetemCounts{.passed = queue.value("packets", std::uint64_t{0}), .dropped = queue.value("drops", std::uint64_t{0})};
}

bool set_netem(const std::string& interface, const std::string& how) {
  const std::string queue = " dev " + quoted(interface) + " root";
  const std::string command = how.empty() ? "tc qdisc del" + queue : "tc qdisc replace" + queue + " netem " + how;
  return std::system((kPath + command + " 2>/dev/null").c_str()) == 0;
}

}  // namespace earshot::hil
