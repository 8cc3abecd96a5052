#include "server/console/app/open_recording.h"

#include <algorithm>
#include <utility>

#include "proto/recording/lesson_reader.h"
#include "server/console/recording_states.h"

namespace tandem::console {
namespace {

RecordingPeriods periods_of(const RecordingOutline& outline) {
  return {outline.head().scene.tick_hz, outline.first(), outline.last()};
}

}  // namespace

std::expected<OpenRecording, std::string> OpenRecording::open(const std::string& path, const rpc::Id& id) {
  auto file = server::RecordingFile::open(path);
  if (!file) return std::unexpected(file.error());
  OpenRecording out;
  out.file_ = std::move(*file);
  auto head = out.read(0, 0);
  if (!head) return std::unexpected(head.error());
  out.base_ = recording_base(*head, id);
  out.outline_ = RecordingOutline(std::move(*head));
  return out;
}

std::expected<Lesson, std::string> OpenRecording::read(std::size_t begin, std::size_t end) const {
  const std::vector<std::byte> bytes = file_.parts().piece(file_.read(), begin, end);
  return read_lesson(bytes);
}

double OpenRecording::progress() const noexcept {
  const std::size_t parts = file_.parts().size();
  return parts == 0 ? 1 : static_cast<double>(next_) / static_cast<double>(parts);
}

void OpenRecording::advance() {
  const server::RecordingParts& parts = file_.parts();
  if (next_ < parts.size()) {
    std::size_t end = next_ + 1;
    while (end < parts.size() && end - next_ < kGroupChunks && parts.bytes(next_, end + 1) <= kGroupBytes) ++end;
    const std::size_t begin = std::exchange(next_, end);
    const auto lesson = read(begin, end);
    whole_ = lesson && outline_.add(*lesson) && whole_;
    const bool later = lesson && lesson->rows() > 0 && (groups_.empty() || lesson->tick[0] > groups_.back().last_tick);
    if (later)
      groups_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), lesson->tick.front(),
                         lesson->tick.back()});
  }
  if (next_ < parts.size() || finished_) return;
  outline_.finish(whole_ && parts.complete());
  finished_ = true;
}

std::uint32_t OpenRecording::pieces() const { return periods_of(outline_).pieces(); }

std::string OpenRecording::piece(std::uint32_t piece) const {
  const RecordingPeriods periods = periods_of(outline_);
  const std::uint64_t from = periods.piece_tick(piece), to = periods.piece_tick(piece + std::uint64_t{1});
  const auto begin = std::ranges::partition_point(groups_, [from](const Group& g) { return g.last_tick < from; });
  const auto end = std::ranges::partition_point(groups_, [to](const Group& g) { return g.first_tick < to; });
  if (begin >= end) return piece_json(periods, piece, outline_.head(), base_);  // a gap of the file
  const auto lesson = read(begin->begin, (end - 1)->end);
  return piece_json(periods, piece, lesson ? *lesson : outline_.head(), base_);
}

}  // namespace tandem::console
