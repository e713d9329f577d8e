#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace earshot::netcdf {

struct ApartLimits {
  unsigned processor_time_s = 20;
  std::size_t more_memory = std::size_t{4} << 30U;  ///< bytes beside those that the process has now
};

/// Does work in a child process, which may crash, run for ever or ask for all the memory there is: HDF5 does so with some damaged files.
///
/// The child is a copy of this process at this moment (fork). Nothing that it changes is seen here but what it writes into SharedBytes:
/// take the results from there and do not repeat the work, for what a damaged file overwrites in memory is another thing each time.
/// @return nothing when the work was done, else how the child ended: "signal 11 (Segmentation fault)"
/// Oracle: NetcdfApart.*
[[nodiscard]] std::optional<std::string> run_apart(const ApartLimits& limits, const std::function<void()>& work);

/// Memory that a child of run_apart shares with its parent. Empty where there is not so much.
class SharedBytes {
 public:
  explicit SharedBytes(std::size_t size);
  ~SharedBytes();
  SharedBytes(const SharedBytes&) = delete;
  SharedBytes& operator=(const SharedBytes&) = delete;

  [[nodiscard]] void* data() const { return data_; }  ///< null: none

 private:
  std::size_t size_;
  void* data_;
};

}  // namespace earshot::netcdf
