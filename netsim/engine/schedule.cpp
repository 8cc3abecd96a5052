#include "netsim/engine/schedule.h"

#include <algorithm>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kEventsMax = 256;
constexpr Duration kEventTimeMax = std::chrono::hours(24 * 30);

bool concerns(const NetworkEvent& event, std::string_view client) {
  return event.clients.empty() || std::ranges::find(event.clients, client) != event.clients.end();
}

bool concerns(const NetworkEvent& event, Direction direction) {
  return !event.direction || *event.direction == direction;
}

void check_link(const LinkSpec& link, const std::string& key, std::vector<SpecError>& all) {
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    for (const SpecError& problem : problems(link[direction])) {
      all.push_back({key + name(direction) + "." + problem.key, problem.message});
    }
  }
}

}  // namespace

LinkSchedule schedule_for(const LinkSpec& base, std::span<const NetworkEvent> events, std::string_view client) {
  std::vector<const NetworkEvent*> mine;
  for (const NetworkEvent& event : events) {
    if (concerns(event, client)) mine.push_back(&event);
  }
  std::ranges::stable_sort(mine, {}, &NetworkEvent::at);

  LinkSchedule schedule{.initial = base};
  for (const NetworkEvent* event : mine) {
    if (event->rebind) schedule.rebinds.push_back({event->at, *event->rebind});
    if (!event->link) continue;
    LinkSpec* now = &schedule.initial;
    if (event->at > Duration::zero()) {
      const LinkSpec before = schedule.changes.empty() ? schedule.initial : schedule.changes.back().link;
      if (schedule.changes.empty() || schedule.changes.back().at < event->at) {
        schedule.changes.push_back({event->at, before});
      }
      now = &schedule.changes.back().link;
    }
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      if (concerns(*event, direction)) (*now)[direction] = (*event->link)[direction];
    }
  }
  // Added last, to every link of the schedule: an outage then persists across changes, and equal links stay equal.
  for (const NetworkEvent* event : mine) {
    if (!event->outage) continue;
    OutageSpec outage = *event->outage;
    outage.start = event->at;
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      if (!concerns(*event, direction)) continue;
      schedule.initial[direction].outages.push_back(outage);
      for (LinkSchedule::Change& change : schedule.changes) change.link[direction].outages.push_back(outage);
    }
  }
  return schedule;
}

std::vector<SpecError> problems(const NetworkEvent& event) {
  SpecErrors found;
  found.range<Duration>("at", event.at, Duration::zero(), kEventTimeMax);
  const int kinds = (event.outage ? 1 : 0) + (event.link ? 1 : 0) + (event.rebind ? 1 : 0);
  if (kinds != 1) found.add("event", "needs exactly one of outage, link, rebind");
  if (event.rebind) {
    found.range<Duration>("rebind.dead_after", event.rebind->dead_after, Duration::zero(), std::chrono::hours(1));
    if (event.direction) found.add("direction", "not with rebind: an address belongs to both directions");
  }
  std::vector<SpecError> all = found.take();
  if (event.link) check_link(*event.link, "link.", all);
  if (event.outage) {
    PathSpec carrier;
    carrier.outages = {*event.outage};
    carrier.outages[0].start = event.at;
    for (const SpecError& problem : problems(carrier)) {
      // The key of the carrier spec is `outages[0].length`. This event has one outage, whose start is `at`, checked
      // above.
      const std::string key = problem.key.substr(problem.key.find('.') + 1);
      if (key != "start") all.push_back({"outage." + key, problem.message});
    }
  }
  return all;
}

std::string sharing_problem(const LinkSpec& base, std::span<const NetworkEvent> events) {
  if (!base.shared) return {};
  for (const NetworkEvent& event : events) {
    if (event.clients.empty() || event.rebind) continue;
    return format("the event at %g s is for ", seconds(event.at)) + event.clients.front() +
           (event.clients.size() > 1 ? " and others" : "") +
           ", but all clients share one link: it changes for all of them, so name none";
  }
  return {};
}

std::vector<SpecError> problems(const LinkSchedule& schedule) {
  std::vector<SpecError> all;
  check_link(schedule.initial, "", all);
  if (schedule.changes.size() > kEventsMax) all.push_back({"changes", "are more than 256"});
  if (schedule.rebinds.size() > kEventsMax) all.push_back({"rebinds", "are more than 256"});
  for (std::size_t i = 0; i < schedule.changes.size(); ++i) {
    const std::string key = "changes[" + std::to_string(i) + "]";
    const Duration at = schedule.changes[i].at;
    const Duration before = i == 0 ? Duration::zero() : schedule.changes[i - 1].at;
    if (at <= before || at > kEventTimeMax)
      all.push_back({key + ".at", "is not after the one before, or above 30 days"});
    check_link(schedule.changes[i].link, key + ".", all);
  }
  for (std::size_t i = 0; i < schedule.rebinds.size(); ++i) {
    const auto& [at, rebind] = schedule.rebinds[i];
    const std::string key = "rebinds[" + std::to_string(i) + "]";
    const Duration before = i == 0 ? Duration::zero() : schedule.rebinds[i - 1].at;
    if (at < before || at > kEventTimeMax)
      all.push_back({key + ".at", "is before the one before, or out of [0, 30 d]"});
    NetworkEvent event{.at = std::clamp(at, Duration::zero(), kEventTimeMax), .rebind = rebind};
    for (const SpecError& problem : problems(event)) all.push_back({key + "." + problem.key, problem.message});
  }
  return all;
}

}  // namespace tandem::netsim
