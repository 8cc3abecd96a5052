#include "netsim/profiles/app/network_numbers.h"

#include "common/base/format.h"
#include "common/base/milliseconds.h"

namespace tandem::netsim {

void NetworkNumbers::apply(PathSpec& path) const {
  const PathSpec wanted = link_from({.delay = from_milliseconds(delay_ms.value_or(0)),
                                     .jitter = from_milliseconds(jitter_ms.value_or(0)),
                                     .loss = loss_percent.value_or(0) / 100,
                                     .duplicate = duplicate_percent.value_or(0) / 100,
                                     .reorder = reorder_percent.value_or(0) / 100})
                              .up;
  if (delay_ms) path.floor = wanted.floor;
  if (jitter_ms) path.body = wanted.body;
  if (loss_percent) path.loss.probability = wanted.loss.probability;
  if (duplicate_percent) path.duplicate = wanted.duplicate;
  if (reorder_percent) path.reorder = wanted.reorder;
}

void NetworkNumbers::apply(LinkSpec& link) const {
  apply(link.up);
  apply(link.down);
}

std::string NetworkNumbers::text() const {
  std::string text;
  const auto add = [&](const char* what, const std::optional<double>& number, const char* unit) {
    if (number) text += format("%s%s%g %s", text.empty() ? "" : ", ", what, *number, unit);
  };
  add("delay ", delay_ms, "ms");
  add("jitter 0 to ", jitter_ms, "ms");
  add("loss ", loss_percent, "%");
  add("duplicates ", duplicate_percent, "%");
  add("reordered ", reorder_percent, "%");
  return text;
}

std::string first_problem(const LinkSpec& link) {
  for (const Direction direction : {Direction::kUp, Direction::kDown})
    for (const SpecError& problem : problems(link[direction]))
      return std::string(name(direction)) + ": " + problem.key + ": " + problem.message;
  return {};
}

}  // namespace tandem::netsim
