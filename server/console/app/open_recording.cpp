#include "server/console/app/open_recording.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "proto/recording/lesson_reader.h"
#include "server/console/recording_states.h"

namespace tandem::console {
namespace {

RecordingPeriods periods_of(const RecordingOutline& outline) {
  return {outline.head().scene.tick_hz, outline.first(), outline.last()};
}

}  // namespace

std::expected<OpenRecording, std::string> OpenRecording::open(const std::vector<std::string>& paths, const rpc::Id& id,
                                                              bool whole) {
  OpenRecording out;
  for (const std::string& path : paths) {
    auto file = server::RecordingFile::open(path);
    if (!file) return std::unexpected((paths.size() > 1 ? path + ": " : "") + file.error());
    out.files_.push_back(std::move(*file));
  }
  auto head = out.read(0, 0, 0);
  if (!head) return std::unexpected(head.error());
  out.base_ = recording_base(*head, id);
  out.outline_ = RecordingOutline(std::move(*head));
  out.whole_ = whole;
  return out;
}

std::expected<Lesson, std::string> OpenRecording::read(std::size_t file, std::size_t begin, std::size_t end) const {
  const std::vector<std::byte> bytes = files_[file].parts().piece(files_[file].read(), begin, end);
  return read_lesson(bytes);
}

double OpenRecording::progress() const noexcept {
  if (file_ == files_.size()) return 1;
  const std::size_t parts = files_[file_].parts().size();
  const double of_file = parts == 0 ? 0 : static_cast<double>(next_) / static_cast<double>(parts);
  return (static_cast<double>(file_) + of_file) / static_cast<double>(files_.size());
}

void OpenRecording::advance() {
  if (finished_) return;
  const server::RecordingParts& parts = files_[file_].parts();
  if (next_ < parts.size()) {
    const std::size_t begin = std::exchange(next_, parts.group_end(next_, kGroupChunks, kGroupBytes));
    const auto lesson = read(file_, begin, next_);
    const bool same = lesson && lesson->scene_text == outline_.head().scene_text;
    whole_ = same && outline_.add(*lesson) && whole_;
    const bool later = same && lesson->rows() > 0 && (groups_.empty() || lesson->tick[0] > groups_.back().last_tick);
    if (later)
      groups_.push_back({static_cast<std::uint32_t>(file_), static_cast<std::uint32_t>(begin),
                         static_cast<std::uint32_t>(next_), lesson->tick.front(), lesson->tick.back()});
  }
  if (next_ < parts.size()) return;
  whole_ = whole_ && parts.complete();
  next_ = 0;
  if (++file_ < files_.size()) return;
  outline_.finish(whole_);
  finished_ = true;
}

std::uint32_t OpenRecording::pieces() const { return periods_of(outline_).pieces(); }

std::string OpenRecording::piece(std::uint32_t piece) const {
  const RecordingPeriods periods = periods_of(outline_);
  const std::uint64_t from = periods.piece_tick(piece), to = periods.piece_tick(piece + std::uint64_t{1});
  auto begin = std::ranges::partition_point(groups_, [from](const Group& g) { return g.last_tick < from; });
  const auto end = std::ranges::partition_point(groups_, [to](const Group& g) { return g.first_tick < to; });
  LessonReader reader;
  bool any = false;
  while (begin < end) {
    const server::RecordingFile& file = files_[begin->file];
    const auto next = std::find_if(begin, end, [begin](const Group& g) { return g.file != begin->file; });
    any = reader.add(file.parts().piece(file.read(), begin->begin, std::prev(next)->end)).has_value() || any;
    begin = next;
  }
  return piece_json(periods, piece, any ? reader.take() : outline_.head(), base_);  // none: a gap of the file
}

}  // namespace tandem::console
