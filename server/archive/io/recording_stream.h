#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/recording/lesson_reader.h"
#include "proto/recording/lesson_source.h"
#include "server/archive/io/recording_file.h"

namespace tandem::server {

/// The files of a recording as one lesson, a few seconds of rows at a time: as LessonReader reads them, with the memory
/// of a few chunks, of the notes, and 16 bytes per chunk of a file. The files are read twice: first for the head.
class RecordingStream final : public LessonSource {
 public:
  static constexpr std::size_t kGroupChunks = 8;          ///< read together: 4 s at 500 ms
  static constexpr std::uint64_t kGroupBytes = 8u << 20;  ///< at most, unless a chunk is larger

  /// Receives the share of the files that was read [0, 1]. Returns false to end it.
  using Progress = std::function<bool(double share)>;
  /// Error text of an end by Progress.
  static constexpr const char* kInterrupted = "interrupted; nothing was written";

  /// Reads the files for the head and the extent.
  /// @param files  of one recording, in their order; at least one
  /// @return error: why they are no recording that can be read, with the name of the file
  [[nodiscard]] static std::expected<std::unique_ptr<RecordingStream>, std::string> open(std::vector<std::string> files,
                                                                                         const Progress& progress);

  [[nodiscard]] const Lesson& head() const override { return head_; }
  [[nodiscard]] LessonExtent extent() const override { return extent_; }
  [[nodiscard]] std::expected<const Lesson*, std::string> next() override;

 private:
  /// One reading of the files from begin to end.
  class Pass {
   public:
    explicit Pass(const std::vector<std::string>& files) : files_(&files) {}
    /// Returns the next rows; may have none. @pre !ended()
    [[nodiscard]] std::expected<Lesson, std::string> next();
    [[nodiscard]] bool ended() const noexcept { return number_ == files_->size(); }
    /// Share of the files that was read [0, 1].
    [[nodiscard]] double share() const noexcept;
    [[nodiscard]] Lesson take() { return reader_.take(); }

   private:
    [[nodiscard]] std::string open_file();

    const std::vector<std::string>* files_;
    std::size_t number_ = 0;  ///< of the present file
    std::size_t chunk_ = 0;   ///< next one
    std::optional<RecordingFile> file_;
    LessonReader reader_;
  };

  explicit RecordingStream(std::vector<std::string> files) : files_(std::move(files)) {}
  [[nodiscard]] std::string read_head(const Progress& progress);

  std::vector<std::string> files_;
  Lesson head_;
  LessonExtent extent_, given_;
  std::optional<Pass> pass_;  ///< of `next`
  Lesson rows_;
};

}  // namespace tandem::server
