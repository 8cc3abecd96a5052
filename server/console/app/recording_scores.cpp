#include "server/console/app/recording_scores.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "common/base/format.h"
#include "netsim/score/lesson_scores.h"
#include "server/archive/app/lesson_file.h"
#include "server/console/app/score_table.h"

namespace tandem::console {
namespace {

constexpr int kScorePriority = 19;  // nice value

RecordingScores::Answer computed(const std::vector<std::string>& paths, const LessonSeatSet& without) {
  const auto lesson = server::load_lesson(paths, without);
  if (!lesson) return {.problem = lesson.error()};
  const auto scores = netsim::score::score_lesson(*lesson);
  if (!scores) return {.problem = scores.error()};
  return {.members = score_members(*scores)};
}

}  // namespace

RecordingScores::RecordingScores() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

RecordingScores::Answer RecordingScores::of(const std::string& id, const std::vector<std::string>& paths,
                                            const RecordingOutline& outline) {
  const std::uint64_t bytes = outline.lesson_bytes();
  if (bytes > kBytesMax)
    return {.problem = format("its scores need %.1f GB of memory here (limit 0.8); compute them with: "
                              "tandem-netsim score FILE",
                              1e-9 * static_cast<double>(bytes))};
  const std::lock_guard hold{lock_};
  const auto known = std::ranges::find(rows_, id, &Row::id);
  if (known != rows_.end()) return known->answer.value_or(Answer{.pending = true});
  rows_.push_front({id, paths, outline.seats_without_samples(), false, {}});
  if (rows_.size() > kKept && !rows_.back().taken) rows_.pop_back();
  wake_.notify_one();
  return {.pending = true};
}

void RecordingScores::forget(const std::string& id) {
  const std::lock_guard hold{lock_};
  std::erase_if(rows_, [&](const Row& row) { return row.id == id; });
}

void RecordingScores::work(const std::stop_token& stop) {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kScorePriority);
  const auto waits = [](const Row& row) { return !row.taken && !row.answer; };
  for (;;) {
    std::unique_lock hold{lock_};
    if (!wake_.wait(hold, stop, [&] { return std::ranges::any_of(rows_, waits); })) return;
    Row& next = *std::ranges::find_if(rows_, waits);
    next.taken = true;
    const std::string id = next.id;
    const std::vector<std::string> paths = next.paths;
    const LessonSeatSet without = next.without;
    hold.unlock();
    Answer answer = computed(paths, without);
    hold.lock();
    const auto row = std::ranges::find(rows_, id, &Row::id);
    if (row == rows_.end()) continue;  // forgotten meanwhile
    row->taken = false;
    row->answer = std::move(answer);
  }
}

}  // namespace tandem::console
