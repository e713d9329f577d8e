#include "firmware/boards/linux/simulation_plugin.hpp"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/shipped.hpp"

namespace earshot::board {
namespace {

std::filesystem::path library_path() {
  std::filesystem::path path = host::shipped_library(kSimulationLibrary);
  if (!path.empty()) return path;
  throw host::BadInput("--simulation: there is no " + std::string(kSimulationLibrary) + " in " + host::own_folder().string() +
                       " or its ../lib/earshot: the simulation is not installed here (Debian package earshot-sil)");
}

}  // namespace

Simulation open_simulation(const SimulationOptions& options) {
  const std::filesystem::path path = library_path();
  // Never closed: what it made lives to the end of the program.
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw host::BadInput(path.string() + ": " + ::dlerror());
  const auto open = reinterpret_cast<OpenSimulation>(::dlsym(library, kOpenSimulationSymbol));
  if (open == nullptr) throw host::BadInput(path.string() + ": is not Earshot's simulation library");
  std::array<char, 256> error{};
  const std::unique_ptr<Simulation> simulation(open(options, error.data(), error.size()));
  if (simulation == nullptr) throw host::BadInput("--simulation " + std::to_string(options.domain) + ": " + error.data());
  return {.clock = std::move(simulation->clock), .port = std::move(simulation->port)};
}

}  // namespace earshot::board
