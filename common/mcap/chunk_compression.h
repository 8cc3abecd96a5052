#pragma once

#include <cstddef>
#include <expected>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace tandem::mcap {

inline constexpr std::string_view kZstd = "zstd";

/// Compresses chunks by zstd. Equal input and library version give equal output. Small chunks get more effort: they are
/// those of sessions with few seats, in which a seat's share of a file is largest.
class Compressor {
 public:
  /// Largest chunk with more effort [bytes]; it takes 24 ms on a core of 2024.
  static constexpr std::size_t kSmallChunk = std::size_t{512} << 10;

  /// @param level  of zstd for chunks that are not small, 1 (fast) to 19
  /// @param small  largest chunk with more effort [bytes]; 0: none
  /// @throws std::bad_alloc
  explicit Compressor(int level, std::size_t small = kSmallChunk);
  /// Replaces `out` by one zstd frame that states its decompressed size. @throws std::bad_alloc
  void compress(std::string_view in, std::string& out);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const noexcept;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> context_, small_;
  std::size_t small_max_;
};

/// Decompresses chunks. Any input is safe.
class Decompressor {
 public:
  /// @throws std::bad_alloc
  Decompressor();
  /// Replaces `out` by the records of a chunk.
  /// @param compression  of the chunk record: empty or "zstd"
  /// @param size         decompressed size that the chunk record states [bytes], at most kChunkBytesMax
  /// Errors: another compression; a size beyond the limit; damaged bytes; another size than stated.
  [[nodiscard]] std::expected<void, std::string> decompress(std::string_view compression, std::span<const std::byte> in,
                                                            std::uint64_t size, std::string& out);

 private:
  struct Free {
    void operator()(ZSTD_DCtx_s* context) const noexcept;
  };
  std::unique_ptr<ZSTD_DCtx_s, Free> context_;
};

}  // namespace tandem::mcap
