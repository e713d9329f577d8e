#include "firmware/boards/linux/memory_proof.hpp"

#include <iomanip>
#include <sstream>

#include "firmware/config/capacities.hpp"
#include "firmware/host/journal/record_ring.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {
namespace {

std::string row(const std::string& what, std::uint64_t bytes, const std::string& remark = {}) {
  std::ostringstream text;
  text << std::setw(12) << bytes << "  " << what << (remark.empty() ? "" : ", ") << remark << "\n";
  return text.str();
}

/// "69 turns: 4 in STANDBY, 60 in SEARCH, 5 in ABORT"
std::string turns_of(const LoopResult& flown) {
  std::string text = std::to_string(flown.turns) + " turns";
  const char* between = ": ";
  for (std::size_t i = 0; i < flown.turns_in.size(); ++i) {
    if (flown.turns_in[i] == 0) continue;
    text += between + std::to_string(flown.turns_in[i]) + " in " + to_string(static_cast<messages::MissionState>(i));
    between = ", ";
  }
  return text;
}

}  // namespace

std::string settle_memory() {
  host::touch_stack(kMainStackBytes);
  host::touch_memory();
  return host::lock_memory();
}

void MemoryProof::arm() {
  before_ = host::process_memory();
  host::arm_heap_trap();
}

void MemoryProof::disarm(const LoopResult& flown) {
  host::disarm_heap_trap();
  after_ = host::process_memory();
  main_stack_used_ = host::touched_stack_used();
  flown_ = flown;
  const auto uses = host::heap_uses();
  uses_.assign(uses.begin(), uses.end());
  threads_ = host::thread_names();
}

bool MemoryProof::has_grown() const {
  return after_.address_space > before_.address_space || after_.anonymous > before_.anonymous;
}

bool MemoryProof::holds() const {
  return uses_.empty() && !has_grown();
}

std::string MemoryProof::verdict() const {
  const std::string where = " in " + std::to_string(threads_.size()) + " threads over " + turns_of(flown_);
  std::string text;
  for (const host::HeapUse& use : uses_) text += host::to_string(use) + "\n";
  if (has_grown()) {
    text += "the memory of the process has grown: address space by " + std::to_string(after_.address_space - before_.address_space) +
            " bytes, memory in use by " + std::to_string(after_.anonymous - before_.anonymous) + "\n";
  }
  return text.empty() ? "0 allocations" + where + "\n" : "memory was asked for after arming," + where + ":\n" + text;
}

std::string MemoryProof::remark() const {
  if (flown_.turns_in[static_cast<std::size_t>(messages::MissionState::kSearch)] > 0) return {};
  return "no SEARCH was flown, so that of a search nothing is proven: give it its vehicle, its SNR and a START";
}

std::string MemoryProof::bill(const PortSet& ports) const {
  std::string text = "memory, in bytes:\n";
  text += row("runtime", sizeof(runtime::Runtime), "of " + std::to_string(config::kRuntimeBytes) + " allowed");
  text += row("journal ring", sizeof(host::RecordRing));
  for (const PortSet::Held& held : ports.memory()) text += row("port " + held.port, held.bytes);
  text += row("stack of the main thread", kMainStackBytes, "of which " + std::to_string(main_stack_used_) + " used");
  for (std::size_t i = 1; i < threads_.size(); ++i) text += row("stack of thread " + threads_[i], kThreadStackBytes);
  text += row("locked", after_.locked, "of an address space of " + std::to_string(after_.address_space));
  text += row("resident at arming", before_.resident, std::to_string(before_.anonymous) + " of it the process's own");
  text += row("resident at the end", after_.resident, std::to_string(after_.anonymous) + " of it the process's own");
  return text;
}

}  // namespace earshot::board
