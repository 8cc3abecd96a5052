#include "netsim/lane.h"

#include <algorithm>
#include <utility>

namespace tandem::netsim {

Lane::Lane(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name)
    : path_(make_path(schedule.initial, direction, seed, name)) {
  const LinkSpec* before = &schedule.initial;
  for (const LinkSchedule::Change& change : schedule.changes) {
    if (change.link[direction] != (*before)[direction]) {
      later_.push_back({Time{change.at}, make_path(change.link, direction, seed, name)});
    }
    before = &change.link;
  }
}

void Lane::switch_to(std::unique_ptr<Path>& next, Time at) noexcept {
  next->take_over(*path_, at);
  std::swap(next, path_);
}

std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed, std::uint64_t name) {
  return std::make_unique<Path>(link[direction], Path::key_for(seed, name, direction), Path::key_for(seed, name));
}

/// Room for 10 s of 1 kHz traffic besides everything that is under way for the longest delay of the models, doubled
/// when everything may come twice. Never more than two minutes' worth: what comes on top is counted as overflow.
std::size_t slots_for(Duration delay_max, double copies) noexcept {
  constexpr double kPerSecond = 1000;
  const double room = kPerSecond * (10.5 + 1.1 * seconds(delay_max));
  return static_cast<std::size_t>(std::min(room * (1 + copies), 120'000.0));
}

std::size_t slots_for(const LinkSchedule& schedule, Direction direction) noexcept {
  const auto needs = [direction](const LinkSpec& link) {
    const PathSpec& spec = link[direction];
    return slots_for(delay_max(spec), spec.duplicate.probability);
  };
  std::size_t most = needs(schedule.initial);
  for (const LinkSchedule::Change& change : schedule.changes) most = std::max(most, needs(change.link));
  return most;
}

}  // namespace tandem::netsim
