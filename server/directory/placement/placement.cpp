#include "server/directory/placement/placement.h"

#include <algorithm>

namespace tandem::directory {

namespace {

bool has_room(const Candidate& candidate, double cost) {
  return takes_sessions(candidate) && candidate.used + cost <= candidate.capacity;
}

double use_with(const Candidate& candidate, double cost) { return (candidate.used + cost) / candidate.capacity; }

}  // namespace

double mean_use(std::span<const Candidate> candidates) noexcept {
  double used = 0, capacity = 0;
  for (const Candidate& candidate : candidates) {
    used += candidate.used;
    if (!candidate.drains) capacity += candidate.capacity;
  }
  return capacity > 0 ? used / capacity : 0;
}

std::optional<std::size_t> Placement::less_used_of_two(std::span<const Candidate> candidates,
                                                       const std::vector<std::size_t>& fitting, double cost) {
  if (fitting.empty()) return std::nullopt;
  const std::size_t one = fitting[draws_.below(fitting.size())], two = fitting[draws_.below(fitting.size())];
  return use_with(candidates[one], cost) <= use_with(candidates[two], cost) ? one : two;
}

std::optional<std::string> Placement::place(std::span<const Candidate> candidates, double cost) {
  std::vector<std::size_t> fitting;
  for (std::size_t n = 0; n < candidates.size(); ++n)
    if (has_room(candidates[n], cost)) fitting.push_back(n);
  const auto chosen = less_used_of_two(candidates, fitting, cost);
  if (!chosen) return std::nullopt;
  return candidates[*chosen].server;
}

std::optional<std::string> Placement::place_standby(std::span<const Candidate> candidates, double cost,
                                                    std::string_view owner, std::string_view present) {
  const auto own = std::ranges::find(candidates, owner, &Candidate::server);
  const std::string_view zone = own == candidates.end() ? std::string_view{} : own->zone;
  std::vector<std::size_t> fitting, elsewhere;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    if (candidates[n].server == owner || !has_room(candidates[n], cost)) continue;
    fitting.push_back(n);
    if (zone.empty() || candidates[n].zone != zone) elsewhere.push_back(n);
  }
  if (!present.empty()) {
    const auto standby = std::ranges::find(candidates, present, &Candidate::server);
    const bool far = standby == candidates.end() || zone.empty() || standby->zone != zone || elsewhere.empty();
    if (far && (standby == candidates.end() || !standby->drains)) return std::nullopt;
  }
  const auto chosen = less_used_of_two(candidates, elsewhere.empty() ? fitting : elsewhere, cost);
  if (!chosen) return std::nullopt;
  return candidates[*chosen].server;
}

}  // namespace tandem::directory
