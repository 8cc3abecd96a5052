#include "server/session/start_condition.h"

#include <algorithm>

namespace tandem::server {

StartCondition::StartCondition(const SceneSpec& scene, std::span<SeatEndpoint> seats,
                               const std::array<bool, kSeatsMax>& present, SessionClock& clock) noexcept
    : scene_(&scene), seats_(seats), present_(&present), clock_(&clock) {}

void StartCondition::restore(const Checkpoint& from) noexcept {
  recovering_ = from.begun;
  if (!recovering_) return;
  stop_before_ = from.stop;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    bool has_authority = false;
    for (std::size_t j = 0; j < scene_->tools.size(); ++j) {
      // A slave seat counts as having authority over its tool.
      const bool master = scene_->seats[i].kind == SeatKind::kMaster;
      has_authority = has_authority || (master ? from.tools[j].alpha[i] > 0 : scene_->seats[i].tool == j);
    }
    required_for_resume_[i] = from.seats[i].taken && (has_authority || seats_[i].role() == AccessRole::kInstructor);
  }
}

void StartCondition::save(Checkpoint& to) const noexcept {
  to.begun = begun();
  for (std::size_t i = 0; i < seats_.size(); ++i) to.seats[i].taken = seats_[i].taken() || required_for_resume_[i];
}

bool StartCondition::step(Time now, bool disengaged) noexcept {
  bool all_ready = true, all_engaged = true;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (!required(i)) continue;
    const bool ready = seats_[i].ready(now);
    all_ready = all_ready && ready;
    all_engaged = all_engaged && (seats_[i].receives_force() ? (*present_)[i] : ready);
  }
  // A session that resumes into a stop engages no seat, because it would release the seat at once.
  const bool into_stop = recovering_ && stop_before_ != StopLatch::Level::kNone;
  may_engage_ = all_ready && !into_stop;
  return all_ready && (all_engaged || into_stop) && !disengaged;
}

void StartCondition::begin(Time now) noexcept {
  if (recovering_) {
    clock_->resume();
  } else {
    clock_->begin();
  }
  recovering_ = false;
  required_for_resume_ = {};
  may_engage_ = true;
  for (SeatEndpoint& seat : seats_)
    if (auto* link = seat.link()) link->restart_statistics(now);
}

std::vector<std::size_t> StartCondition::missing(Time now) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < seats_.size(); ++i)
    if (required(i) && !seats_[i].ready(now)) out.push_back(i);
  return out;
}

}  // namespace tandem::server
