#include "server/archive/io/recording_stream.h"

#include <new>
#include <utility>

namespace tandem::server {
namespace {

constexpr const char* kNoMemory = "a part of it is too large for the memory of this computer";

/// Adds the rows of a later piece to the extent.
void extend(LessonExtent& extent, const Lesson& rows) {
  const LessonExtent more = extent_of(rows);
  if (more.rows == 0) return;
  if (extent.rows == 0) extent.first_tick = more.first_tick;
  extent.last_tick = more.last_tick;
  extent.rows += more.rows;
}

}  // namespace

std::string RecordingStream::Pass::open_file() {
  const std::string& name = (*files_)[number_];
  auto file = RecordingFile::open(name);
  if (!file) return name + ": " + file.error();
  file_.emplace(std::move(*file));
  chunk_ = 0;
  const auto begun = reader_.begin_file(file_->parts().piece(file_->read(), 0, 0), file_->bytes());
  return begun ? std::string{} : name + ": " + begun.error();
}

std::expected<Lesson, std::string> RecordingStream::Pass::next() try {
  if (!file_)
    if (std::string problem = open_file(); !problem.empty()) return std::unexpected(std::move(problem));
  const RecordingParts& parts = file_->parts();
  if (chunk_ < parts.size()) {
    const std::size_t begin = std::exchange(chunk_, parts.group_end(chunk_, kGroupChunks, kGroupBytes));
    reader_.add_piece(parts.piece(file_->read(), begin, chunk_));
  }
  if (chunk_ == parts.size()) {
    reader_.end_file(parts.complete());
    file_.reset();
    ++number_;
  }
  return reader_.take_rows(ended());
} catch (const std::bad_alloc&) {
  return std::unexpected((*files_)[number_] + ": " + kNoMemory);
}

double RecordingStream::Pass::share() const noexcept {
  const std::size_t chunks = file_ ? file_->parts().size() : 0;
  const double of_file = chunks == 0 ? 0 : static_cast<double>(chunk_) / static_cast<double>(chunks);
  return (static_cast<double>(number_) + of_file) / static_cast<double>(files_->size());
}

std::expected<std::unique_ptr<RecordingStream>, std::string> RecordingStream::open(std::vector<std::string> files,
                                                                                   const Progress& progress) {
  std::unique_ptr<RecordingStream> stream{new RecordingStream(std::move(files))};
  if (std::string problem = stream->read_head(progress); !problem.empty()) return std::unexpected(std::move(problem));
  return stream;
}

std::string RecordingStream::read_head(const Progress& progress) {
  Pass pass(files_);
  while (!pass.ended()) {
    const auto rows = pass.next();
    if (!rows) return rows.error();
    extend(extent_, *rows);
    if (!progress(pass.share())) return kInterrupted;
  }
  head_ = pass.take();
  pass_.emplace(files_);
  return {};
}

std::expected<const Lesson*, std::string> RecordingStream::next() {
  while (!pass_->ended()) {
    auto rows = pass_->next();
    if (!rows) return std::unexpected(std::move(rows.error()));
    if (rows->rows() == 0) continue;
    rows_ = std::move(*rows);
    extend(given_, rows_);
    return &rows_;
  }
  if (given_ != extent_) return std::unexpected(files_.front() + ": was changed while it was read; repeat the command");
  return nullptr;
}

}  // namespace tandem::server
