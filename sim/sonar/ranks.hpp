#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace earshot::sonar {

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
};

/// One process.
class Alone : public Ranks {
 public:
  [[nodiscard]] std::size_t rank() const override { return 0; }
  [[nodiscard]] std::size_t size() const override { return 1; }
  void share(std::vector<std::int32_t>&) override {}
  void send(std::span<const float>) override {}
  void receive(std::size_t, std::span<float>) override {}
};

}  // namespace earshot::sonar
