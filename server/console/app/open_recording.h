#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <vector>

#include "server/archive/io/recording_file.h"
#include "server/console/recording_outline.h"
#include "server/console/session_picture.h"

namespace tandem::console {

/// A recording that pages play. Its outline is read first, a few chunks at a time; then it gives pieces. Memory: the
/// outline, 16 bytes per group of chunks, and the rows of one piece.
class OpenRecording {
 public:
  static constexpr std::size_t kGroupChunks = 8;          ///< 2 s at 250 ms
  static constexpr std::uint64_t kGroupBytes = 8u << 20;  ///< at most, unless a chunk is larger

  /// @param id  by which pages ask for it
  /// @return error: why the file cannot be read, without its name
  [[nodiscard]] static std::expected<OpenRecording, std::string> open(const std::string& path, const rpc::Id& id);

  /// Whether the outline is complete.
  [[nodiscard]] bool ready() const noexcept { return next_ == file_.parts().size() && finished_; }
  /// Part of the file that was read [0, 1].
  [[nodiscard]] double progress() const noexcept;
  /// Reads the next group of chunks for the outline.
  void advance();
  [[nodiscard]] const RecordingOutline& outline() const noexcept { return outline_; }
  /// @pre ready() and the outline has rows
  [[nodiscard]] std::uint32_t pieces() const;
  /// Returns the JSON text of a piece. @pre piece < pieces()
  [[nodiscard]] std::string piece(std::uint32_t piece) const;
  /// False: the file was changed or deleted, so that it must not be shown any more.
  [[nodiscard]] bool unchanged() const noexcept { return file_.unchanged(); }

 private:
  struct Group {
    std::uint32_t begin = 0, end = 0;  ///< chunks
    std::uint32_t first_tick = 0, last_tick = 0;
  };
  [[nodiscard]] std::expected<Lesson, std::string> read(std::size_t begin, std::size_t end) const;

  server::RecordingFile file_;
  LivePicture base_;
  RecordingOutline outline_;
  std::vector<Group> groups_;  ///< with rows, in the order of ticks
  std::size_t next_ = 0;       ///< chunk
  bool whole_ = true, finished_ = false;
};

}  // namespace tandem::console
