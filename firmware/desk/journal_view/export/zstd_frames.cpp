#include "firmware/desk/journal_view/export/zstd_frames.hpp"

#include <zstd.h>

#include <cstddef>
#include <new>

namespace earshot::journal {

void ZstdFrames::Free::operator()(ZSTD_CCtx_s* context) const {
  (void)ZSTD_freeCCtx(context);
}

ZstdFrames::ZstdFrames() : context_(ZSTD_createCCtx()) {
  if (context_ == nullptr) throw std::bad_alloc();
}

std::string_view ZstdFrames::compress(std::string_view piece) {
  frame_.resize(ZSTD_compressBound(piece.size()));
  const std::size_t size = ZSTD_compress2(context_.get(), frame_.data(), frame_.size(), piece.data(), piece.size());
  if (ZSTD_isError(size) != 0U) throw std::bad_alloc();  // with room enough for the frame, memory alone can be missing
  return std::string_view(frame_).substr(0, size);
}

}  // namespace earshot::journal
