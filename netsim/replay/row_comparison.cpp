#include "netsim/replay/row_comparison.h"

#include <algorithm>
#include <utility>

#include "common/base/format.h"
#include "proto/recording/tick_messages.h"
#include "server/recording/lesson_record.h"
#include "server/recording/tool_sample.h"

namespace tandem::netsim {

std::optional<ReplayDifference> RowComparison::add(std::shared_ptr<const Lesson> lesson) {
  if (lesson->rows() == 0) return std::nullopt;
  if (!first_) first_ = lesson->tick.front();
  lessons_.push_back(std::move(lesson));
  while (!waiting_.empty() && waiting_.front().record->tick <= lessons_.back()->tick.back()) {
    const Waiting first = std::move(waiting_.front());
    waiting_.pop_front();
    if (auto difference = compare(*first.record, first.tick)) return difference;
  }
  return std::nullopt;
}

std::optional<ReplayDifference> RowComparison::compare(const server::Session& session, std::uint64_t tick) {
  count_unseen(session);
  const server::TickRecord& record = session.record();
  if (!session.recorded() || (last_ ? record.tick <= *last_ : !record.running)) return std::nullopt;
  last_ = record.tick;
  if (!lessons_.empty() && record.tick <= lessons_.back()->tick.back()) return compare(record, tick);
  if (waiting_.size() < kWaitingMax) waiting_.push_back({tick, std::make_unique<server::TickRecord>(record)});
  return std::nullopt;
}

std::optional<ReplayDifference> RowComparison::compare(const server::TickRecord& record, std::uint64_t tick) {
  while (lessons_.size() > 1 && record.tick > lessons_.front()->tick.back()) {
    lessons_.pop_front();
    row_ = digest_ = 0;
    static_cast<void>(own_digest_.take());
  }
  const Lesson& lesson = *lessons_.front();
  while (row_ < lesson.rows() && lesson.tick[row_] < record.tick) ++row_;
  if (row_ >= lesson.rows() || lesson.tick[row_] != record.tick) return std::nullopt;  // it was dropped
  server::fill_record(lesson, row_, recorded_);
  if (!seats_) {
    recorded_.seats = record.seats;
    for (std::size_t j = 0; j < scene_->tools.size(); ++j)
      if (scene_->tools[j].remote) recorded_.tools[j] = record.tools[j];
  }
  ++rows_;
  replayed_ = record;
  if (rounded_) round_tools(replayed_);
  RecordValues::read(*scene_, recorded_, before_);
  RecordValues::read(*scene_, replayed_, now_);
  auto difference = values_.difference(before_, now_);
  if (!difference && rounded_) difference = compare_digest(lesson, record);
  if (difference) {
    difference->tick = tick;
    difference->session_tick = record.tick;
  }
  return difference;
}

/// Counts a tick, and the missed ones before it, which advance the session's clock too.
void RowComparison::count_unseen(const server::Session& session) {
  if (session.state() != wire::SessionState::kRunning) return;
  const std::uint32_t now = session.clock().session_tick(), counted = uncounted_.value_or(now);
  if (now < counted) return;  // a restarted server repeats ticks
  uncounted_ = now + 1;
  if (first_ && counted < *first_) unseen_ += std::min(now + 1, *first_) - counted;
}

void RowComparison::round_tools(server::TickRecord& record) const noexcept {
  for (std::size_t j = 0; j < scene_->tools.size(); ++j) {
    rec::ToolSample sample = server::sample_of(record.tools[j]);
    rec::round_tool(sample);
    server::set_sample(sample, record.tools[j]);
  }
}

/// Compares the digest of a chunk once its last row was compared.
std::optional<ReplayDifference> RowComparison::compare_digest(const Lesson& lesson, const server::TickRecord& record) {
  own_digest_.add(record, scene_->tools.size());
  if (digest_ >= lesson.digests.size() || record.tick < lesson.digests[digest_].tick) return std::nullopt;
  const std::uint64_t recorded = lesson.digests[digest_++].tools, own = own_digest_.take();
  if (own == recorded) return std::nullopt;
  return ReplayDifference{.channel = "/tools/digest",
                          .recorded = format("%016llx", static_cast<unsigned long long>(recorded)),
                          .replayed = format("%016llx", static_cast<unsigned long long>(own))};
}

}  // namespace tandem::netsim
