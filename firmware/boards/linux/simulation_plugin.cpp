#include "firmware/boards/linux/simulation_plugin.hpp"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;

fs::path library_path() {
  const fs::path beside = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& folder : {beside, beside / "../lib/earshot"}) {
    std::error_code error;
    if (fs::exists(folder / kSimulationLibrary, error)) return folder / kSimulationLibrary;
  }
  throw host::BadInput("--simulation: there is no " + std::string(kSimulationLibrary) + " in " + beside.string() +
                       " or its ../lib/earshot: the simulation is not installed here");
}

}  // namespace

Simulation open_simulation(const SimulationOptions& options) {
  const fs::path path = library_path();
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
