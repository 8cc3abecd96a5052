#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// A recording that is read in parts, because a lesson of two hours does not fit into the memory of a small computer.
namespace tandem::server {

/// Reads bytes of a file from `offset` on. @return their number; less than asked for at the end, or after an error
using ReadAt = std::function<std::size_t(std::uint64_t offset, std::span<std::byte> into)>;

/// Where the messages of a recording are. It holds the definitions of the file, and 16 bytes per chunk of messages.
class RecordingParts {
 public:
  static constexpr std::size_t kDefinitionsMax = 16u << 20;  ///< bytes outside of messages that are read
  static constexpr std::size_t kPartsMax = 1'000'000;        ///< chunks: 69 hours at 250 ms

  /// Finds the parts from record to record, without reading the messages. Any bytes are safe. A cut file gives the
  /// whole records before the cut.
  /// @return error: why this is no recording that can be read, without the name of the file
  [[nodiscard]] static std::expected<RecordingParts, std::string> find(const ReadAt& read, std::uint64_t file_size);

  /// Number of chunks.
  [[nodiscard]] std::size_t size() const noexcept { return parts_.size(); }
  /// The file has an end, and an account of its ticks. A repaired file has no account.
  [[nodiscard]] bool complete() const noexcept { return complete_; }
  /// Size of the chunks [begin, end) in the file [bytes].
  [[nodiscard]] std::uint64_t bytes(std::size_t begin, std::size_t end) const noexcept;
  /// Returns the end of the chunks from `begin` on that are read together: one at least, at most `count`, and further
  /// ones only up to this size in the file. @pre begin < size()
  [[nodiscard]] std::size_t group_end(std::size_t begin, std::size_t count, std::uint64_t bytes_max) const noexcept;
  /// Returns a recording with the definitions of the file and only the messages of the chunks [begin, end), without a
  /// summary. Chunks that can no longer be read are missing.
  [[nodiscard]] std::vector<std::byte> piece(const ReadAt& read, std::size_t begin, std::size_t end) const;

 private:
  struct Part {
    std::uint64_t offset = 0, bytes = 0;
  };
  std::vector<std::byte> head_;  ///< magic, header, and definitions before the first message
  std::vector<std::byte> rest_;  ///< metadata between and after the messages
  std::vector<Part> parts_;
  bool complete_ = false;
};

}  // namespace tandem::server
