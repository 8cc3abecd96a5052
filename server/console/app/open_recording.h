#pragma once

#include <algorithm>
#include <cstdint>
#include <expected>
#include <string>
#include <vector>

#include "server/archive/io/recording_file.h"
#include "server/console/recording_outline.h"
#include "server/console/session_picture.h"

namespace tandem::console {

/// A recording of one or more files that pages play. Its outline is read first, a few chunks at a time; then it gives
/// pieces. Memory: the outline, 20 bytes per group of chunks, and the rows of one piece.
class OpenRecording {
 public:
  static constexpr std::size_t kGroupChunks = 8;          ///< 4 s at 500 ms
  static constexpr std::uint64_t kGroupBytes = 8u << 20;  ///< at most, unless a chunk is larger

  /// @param paths  of its files, in their order; at least one
  /// @param id     by which pages ask for it
  /// @param whole  no file is missing
  /// @return error: why a file cannot be read; of several files with its name
  [[nodiscard]] static std::expected<OpenRecording, std::string> open(const std::vector<std::string>& paths,
                                                                      const rpc::Id& id, bool whole);

  /// Whether the outline is complete.
  [[nodiscard]] bool ready() const noexcept { return finished_; }
  /// Part of the files that was read [0, 1].
  [[nodiscard]] double progress() const noexcept;
  /// Reads the next group of chunks for the outline.
  void advance();
  [[nodiscard]] const RecordingOutline& outline() const noexcept { return outline_; }
  /// @pre ready() and the outline has rows
  [[nodiscard]] std::uint32_t pieces() const;
  /// Returns the JSON text of a piece. @pre piece < pieces()
  [[nodiscard]] std::string piece(std::uint32_t piece) const;
  /// False: a file was changed or deleted, so that it must not be shown any more.
  [[nodiscard]] bool unchanged() const noexcept {
    return std::ranges::all_of(files_, &server::RecordingFile::unchanged);
  }

 private:
  struct Group {
    std::uint32_t file = 0;
    std::uint32_t begin = 0, end = 0;  ///< chunks
    std::uint32_t first_tick = 0, last_tick = 0;
  };
  [[nodiscard]] std::expected<Lesson, std::string> read(std::size_t file, std::size_t begin, std::size_t end) const;

  std::vector<server::RecordingFile> files_;
  LivePicture base_;
  RecordingOutline outline_;
  std::vector<Group> groups_;  ///< with rows, in the order of ticks
  std::size_t file_ = 0;       ///< that is read next
  std::size_t next_ = 0;       ///< chunk of it
  bool whole_ = true, finished_ = false;
};

}  // namespace tandem::console
