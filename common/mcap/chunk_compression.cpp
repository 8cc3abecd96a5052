#include "common/mcap/chunk_compression.h"

#include <zstd.h>

#include <new>

#include "common/base/raw_bytes.h"
#include "common/mcap/mcap_records.h"

namespace tandem::mcap {

void Compressor::Free::operator()(ZSTD_CCtx_s* context) const noexcept { ZSTD_freeCCtx(context); }
void Decompressor::Free::operator()(ZSTD_DCtx_s* context) const noexcept { ZSTD_freeDCtx(context); }

Compressor::Compressor(int level) : context_(ZSTD_createCCtx()) {
  if (context_ == nullptr || ZSTD_isError(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, level)) != 0)
    throw std::bad_alloc();
}

void Compressor::compress(std::string_view in, std::string& out) {
  out.resize(ZSTD_compressBound(in.size()));
  const std::size_t size = ZSTD_compress2(context_.get(), out.data(), out.size(), in.data(), in.size());
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();  // with room for the bound, memory is all that can be short
  out.resize(size);
}

Decompressor::Decompressor() : context_(ZSTD_createDCtx()) {
  if (context_ == nullptr) throw std::bad_alloc();
}

std::expected<void, std::string> Decompressor::decompress(std::string_view compression, std::span<const std::byte> in,
                                                          std::uint64_t size, std::string& out) {
  if (size > kChunkBytesMax)
    return std::unexpected("has " + std::to_string(size) + " bytes, more than " + std::to_string(kChunkBytesMax));
  if (compression.empty()) {
    if (in.size() != size) return std::unexpected("has another size than it states");
    out.assign(text_of(in));
    return {};
  }
  if (compression != kZstd)
    return std::unexpected("has compression \"" + std::string(compression.substr(0, 32)) +
                           "\"; only zstd and none are read");
  // The frame's own size comes first: a stated size alone must not take memory.
  const unsigned long long framed = ZSTD_getFrameContentSize(in.data(), in.size());
  if (framed == ZSTD_CONTENTSIZE_ERROR || (framed != ZSTD_CONTENTSIZE_UNKNOWN && framed != size))
    return std::unexpected("has damaged zstd data");
  out.resize(static_cast<std::size_t>(size));
  const std::size_t got = ZSTD_decompressDCtx(context_.get(), out.data(), out.size(), in.data(), in.size());
  if (ZSTD_isError(got) != 0 || got != size) return std::unexpected("has damaged zstd data");
  return {};
}

}  // namespace tandem::mcap
