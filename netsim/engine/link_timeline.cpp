#include "netsim/engine/link_timeline.h"

#include "netsim/engine/link_direction.h"

namespace tandem::netsim {

template <typename Make>
void LinkTimeline::plan(const LinkSchedule& schedule, Direction direction, const Make& make) {
  path_ = make(schedule.initial);
  clients_.resize(path_->flows());
  const LinkSpec* before = &schedule.initial;
  for (const LinkSchedule::Change& change : schedule.changes) {
    if (change.link[direction] != (*before)[direction]) planned_.push_back({Time{change.at}, make(change.link)});
    before = &change.link;
  }
}

LinkTimeline::LinkTimeline(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name) {
  plan(schedule, direction, [&](const LinkSpec& link) { return make_path(link, direction, seed, name); });
}

LinkTimeline::LinkTimeline(const LinkSchedule& schedule, Direction direction, std::uint64_t seed,
                           const Shared& shared) {
  plan(schedule, direction, [&](const LinkSpec& link) { return make_path(link, direction, seed, shared); });
}

void LinkTimeline::join(std::uint32_t flow, std::uint64_t name) {
  if (flow == clients_.size()) clients_.emplace_back();
  path_->set_flow(flow, name);
  for (std::size_t i = next_; i < planned_.size(); ++i) planned_[i].path->set_flow(flow, name);
}

void LinkTimeline::detach(std::uint32_t flow) noexcept {
  clients_[flow] = {};
  path_->remove_flow(flow);
}

void LinkTimeline::change(Time now, std::unique_ptr<Path>& next) noexcept {
  dispatch_resolved(now);
  while (const auto settled = path_->flush(*next)) dispatch(*settled);
  next->replace(*path_, now);
  std::swap(next, path_);
}

void LinkTimeline::dispatch_resolved(Time now) noexcept {
  while (const auto settled = path_->resolve(now)) dispatch(*settled);
}

void LinkTimeline::dispatch(const Path::Resolved& settled) noexcept {
  if (settled.flow == Path::kNoFlow || settled.ticket == InTransit::kNoTicket) return;
  const Client& member = clients_[settled.flow];
  if (member.direction != nullptr) {
    netsim::resolve(settled.decision, settled.ticket, *member.queue, member.direction->counters, member.direction->tap);
  }
}

std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed, std::uint64_t name) {
  return std::make_unique<Path>(link[direction], Path::keys_for(seed, name, direction));
}

std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed,
                                const LinkTimeline::Shared& shared) {
  auto path = std::make_unique<Path>(link[direction], Path::shared_keys(seed, shared.number, direction));
  for (std::uint32_t flow = 1; flow < shared.flows; ++flow) path->set_flow(flow, flow);
  return path;
}

}  // namespace tandem::netsim
