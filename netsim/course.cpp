#include "netsim/course.h"

#include "netsim/lane.h"

namespace tandem::netsim {

template <typename Make>
void Course::plan(const LinkSchedule& schedule, Direction direction, const Make& make) {
  path_ = make(schedule.initial);
  members_.resize(path_->flows());
  const LinkSpec* before = &schedule.initial;
  for (const LinkSchedule::Change& change : schedule.changes) {
    if (change.link[direction] != (*before)[direction]) later_.push_back({Time{change.at}, make(change.link)});
    before = &change.link;
  }
}

Course::Course(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name) {
  plan(schedule, direction, [&](const LinkSpec& link) { return make_path(link, direction, seed, name); });
}

Course::Course(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, const Shared& shared) {
  plan(schedule, direction, [&](const LinkSpec& link) { return make_path(link, direction, seed, shared); });
}

void Course::join(std::uint32_t flow, std::uint64_t name) {
  if (flow == members_.size()) members_.emplace_back();
  path_->set_flow(flow, name);
  for (std::size_t i = next_; i < later_.size(); ++i) later_[i].path->set_flow(flow, name);
}

void Course::leave(std::uint32_t flow) noexcept {
  members_[flow] = {};
  path_->forget(flow);
}

void Course::change(Time now, std::unique_ptr<Path>& next) noexcept {
  hand_out(now);
  while (const auto settled = path_->drain(*next)) hand(*settled);
  next->take_over(*path_, now);
  std::swap(next, path_);
}

void Course::hand_out(Time now) noexcept {
  while (const auto settled = path_->settle(now)) hand(*settled);
}

void Course::hand(const Path::Settled& settled) noexcept {
  if (settled.flow == Path::kNobody || settled.ticket == InTransit::kNoTicket) return;
  const Member& member = members_[settled.flow];
  if (member.lane != nullptr) {
    netsim::settle(settled.verdict, settled.ticket, *member.queue, member.lane->counters, member.lane->tap);
  }
}

std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed, std::uint64_t name) {
  return std::make_unique<Path>(link[direction], Path::keys_for(seed, name, direction));
}

std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed,
                                const Course::Shared& shared) {
  auto path = std::make_unique<Path>(link[direction], Path::shared_keys(seed, shared.number, direction));
  for (std::uint32_t flow = 1; flow < shared.flows; ++flow) path->set_flow(flow, flow);
  return path;
}

}  // namespace tandem::netsim
