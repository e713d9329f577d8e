#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace earshot::parallel {

/// The processes that share one piece of work, perhaps on several machines. Rank 0 writes the files. Called from one thread only.
class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  [[nodiscard]] virtual std::size_t rank() const = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  virtual void share(std::vector<std::int32_t>& values) = 0;            ///< afterwards all have what rank 0 has
  virtual void send(std::span<const float> values) = 0;                 ///< to rank 0; returns when that receives it
  virtual void receive(std::size_t from, std::span<float> values) = 0;  ///< on rank 0: what `from` sent, in its order
  /// On every rank: what all gave, rank 0's first. @param all  of size() times mine's size
  virtual void gather_everywhere(std::span<const float> mine, std::span<float> all) = 0;
  /// On rank 0: what all gave, in order of rank; elsewhere nothing.
  [[nodiscard]] virtual std::vector<std::string> gather(const std::string& mine) = 0;
};

/// On rank 0: the values that all gave, in order of rank; elsewhere nothing.
template <class T>
[[nodiscard]] std::vector<std::vector<T>> gather_values(Ranks& ranks, std::span<const T> mine) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::vector<T>> all;
  for (const std::string& bytes : ranks.gather({reinterpret_cast<const char*>(mine.data()), mine.size_bytes()})) {
    std::vector<T>& values = all.emplace_back(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  }
  return all;
}

/// One process.
class Alone : public Ranks {
 public:
  [[nodiscard]] std::size_t rank() const override { return 0; }
  [[nodiscard]] std::size_t size() const override { return 1; }
  void share(std::vector<std::int32_t>&) override {}
  void send(std::span<const float>) override {}
  void receive(std::size_t, std::span<float>) override {}
  void gather_everywhere(std::span<const float> mine, std::span<float> all) override { std::ranges::copy(mine, all.begin()); }
  [[nodiscard]] std::vector<std::string> gather(const std::string& mine) override { return {mine}; }
};

}  // namespace earshot::parallel
