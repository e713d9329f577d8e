#include "tests/outage/power_cut.hpp"

#include <algorithm>
#include <cstddef>

namespace earshot::outage {
namespace {

constexpr std::size_t kSector_bytes = 512;  ///< a disk writes a whole one or none of it

std::size_t below(Pcg32& random, std::size_t bound) {
  return static_cast<std::size_t>(random.uniform_double() * static_cast<double>(bound));
}

}  // namespace

void FolderOnDisk::follow(const DiskCall& call) {
  switch (call.kind) {
    case DiskCall::Kind::kCreate:
      files_[call.file] = {};
      return;
    case DiskCall::Kind::kWrite: {
      File& file = files_.at(call.file);
      file.now.resize(std::max<std::size_t>(file.now.size(), call.offset + call.bytes.size()));
      std::ranges::copy(call.bytes, file.now.begin() + static_cast<std::ptrdiff_t>(call.offset));
      file.between.push_back(file.now);
      return;
    }
    case DiskCall::Kind::kCut: {
      File& file = files_.at(call.file);
      file.now.resize(call.offset);
      file.between.push_back(file.now);
      return;
    }
    case DiskCall::Kind::kBringToDisk: {
      File& file = files_.at(call.file);
      file.kept = file.now;
      file.between.clear();
      return;
    }
    case DiskCall::Kind::kKeepEntries:
      for (auto& [name, file] : files_) file.is_entry_kept = true;
      return;
    case DiskCall::Kind::kRemove:
      files_.erase(call.file);
      return;
  }
}

Files FolderOnDisk::after_power_cut(Unsynced unsynced, Pcg32& random) const {
  Files left;
  for (const auto& [name, file] : files_) {
    const bool is_there = file.is_entry_kept || unsynced == Unsynced::kThere || (unsynced == Unsynced::kTorn && below(random, 2) == 0);
    if (!is_there) continue;
    left[name] = unsynced == Unsynced::kLost ? file.kept : (unsynced == Unsynced::kThere ? file.now : torn(file, random));
  }
  return left;
}

FolderOnDisk::Bytes FolderOnDisk::torn(const File& file, Pcg32& random) {
  std::vector<const Bytes*> states{&file.kept};
  for (const Bytes& state : file.between) states.push_back(&state);
  const auto any = [&]() -> const Bytes& { return *states[below(random, states.size())]; };
  Bytes left(any().size());
  for (std::size_t begin = 0; begin < left.size(); begin += kSector_bytes) {
    const Bytes& state = any();
    const std::size_t end = std::min({left.size(), begin + kSector_bytes, state.size()});
    for (std::size_t i = begin; i < end; ++i) left[i] = state[i];
  }
  return left;
}

}  // namespace earshot::outage
