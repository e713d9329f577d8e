#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "firmware/core/random.hpp"
#include "tests/outage/recorded_disk.hpp"

namespace earshot::outage {

/// What becomes at a power cut of what the disk had not been told to keep.
enum class Unsynced : std::uint8_t {
  kLost,   ///< nothing of it is there
  kThere,  ///< all of it is, as if the program alone had been killed
  kTorn,   ///< each piece of 512 bytes is as it ever was since, the file ends where it ever did, what was never written is zeros
};

using Files = std::map<std::string, std::vector<std::uint8_t>>;

/// A folder as a disk may have it: what was brought to the disk stands there; of everything else a disk and a file system may have written
/// any part, in any order.
class FolderOnDisk {
 public:
  void follow(const DiskCall& call);
  /// Its files, were the power to fail now.
  [[nodiscard]] Files after_power_cut(Unsynced unsynced, Pcg32& random) const;

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct File {
    bool is_entry_kept = false;
    Bytes now;
    Bytes kept;                  ///< when it was last brought to the disk
    std::vector<Bytes> between;  ///< after each call since
  };
  [[nodiscard]] static Bytes torn(const File& file, Pcg32& random);

  std::map<std::string, File> files_;
};

}  // namespace earshot::outage
