#pragma once

#include <memory>
#include <string>
#include <string_view>

struct ZSTD_CCtx_s;

namespace earshot::journal {

/// Compresses pieces of a file, one after the other, into zstd frames that stand alone. Memory: 1.3 MiB for
/// pieces of 1 MiB (ZSTD_sizeof_CCtx), and the largest frame.
/// Source: RFC 8878 (by libzstd, at its default level)
class ZstdFrames {
 public:
  ZstdFrames();
  /// @return valid until the next. @throws std::bad_alloc
  [[nodiscard]] std::string_view compress(std::string_view piece);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  std::string frame_;
};

}  // namespace earshot::journal
