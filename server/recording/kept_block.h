#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/mcap/chunk_compression.h"

/// Blocks of inputs (server/recording/input_block.h) as a spool keeps them until a recording begins. The blocks need no
/// rows of a recording. Each entry of a spool: u32 compressed size, u32 size of the block, u32 CRC-32 of the compressed
/// bytes, then these bytes, one zstd frame. Numbers are little-endian.
namespace tandem::server {

/// Head of an entry.
struct KeptBlockHead {
  static constexpr std::size_t kSize = 12;  ///< [bytes]

  std::uint32_t packed = 0;  ///< compressed size [bytes]
  std::uint32_t size = 0;    ///< of the block [bytes]
  std::uint32_t crc = 0;
};

/// Compresses blocks into entries, with little effort: the recording compresses them again.
class KeptBlockWriter {
 public:
  KeptBlockWriter();
  /// Replaces `out` by the entry of a block. @pre the block is not empty. @throws std::bad_alloc
  void write(std::string_view block, std::string& out);

 private:
  mcap::Compressor compressor_;
  std::string packed_;
};

/// Reads entries. Any bytes are safe.
class KeptBlockReader {
 public:
  /// Reads a head. @return nullopt: it states sizes that no entry has
  [[nodiscard]] static std::optional<KeptBlockHead> read_head(
      std::span<const std::byte, KeptBlockHead::kSize> bytes) noexcept;
  /// Returns the block of an entry, valid until the next call; or why it is damaged.
  /// @param packed  the bytes behind the head
  [[nodiscard]] std::expected<std::string_view, std::string> read(const KeptBlockHead& head,
                                                                  std::span<const std::byte> packed);

 private:
  mcap::Decompressor decompressor_;
  std::string block_;
};

}  // namespace tandem::server
