#include "server/directory/placement/move_planner.h"

#include <algorithm>

namespace tandem::directory {

namespace {

/// Candidates with the expected in the place of the measured processor time.
std::vector<Candidate> when_all_seats_are_taken(std::span<const Candidate> servers) {
  std::vector<Candidate> out(servers.begin(), servers.end());
  for (Candidate& server : out) server.used = server.expected;
  return out;
}

std::vector<const PlacedSession*> dearest_first(std::span<const PlacedSession> sessions, auto&& fits) {
  std::vector<const PlacedSession*> out;
  for (const PlacedSession& session : sessions)
    if (fits(session)) out.push_back(&session);
  std::ranges::stable_sort(out, std::ranges::greater{}, [](const PlacedSession* s) { return s->cost; });
  return out;
}

}  // namespace

bool MovePlanner::settled(Time now, std::span<const Candidate> candidates) {
  const auto same = [&] { return std::ranges::equal(known_, candidates, {}, {}, &Candidate::server); };
  if (!same()) {
    known_.clear();
    for (const Candidate& candidate : candidates) known_.push_back(candidate.server);
    changed_ = now;
  }
  return now - *changed_ >= kSettle;
}

std::optional<PlannedMove> MovePlanner::step(Time now, std::span<const Candidate> candidates, std::string_view own,
                                             std::span<const PlacedSession> sessions) {
  if (candidates.size() < 2) {
    known_.clear();
    return std::nullopt;
  }
  const bool calm = settled(now, candidates);
  while (!sent_.empty() && now - sent_.front().at >= kRecordAge) sent_.pop_front();
  std::erase_if(moved_, [&](const auto& moved) { return now - moved.second >= kRest; });
  std::vector<Candidate> servers(candidates.begin(), candidates.end());
  const auto self = std::ranges::find(servers, own, &Candidate::server);
  if (self == servers.end()) return std::nullopt;
  for (const Sent& sent : sent_) {
    const auto to = std::ranges::find(servers, sent.server, &Candidate::server);
    if (to == servers.end()) continue;
    to->used += sent.cost;
    to->expected += sent.expected;
  }
  std::optional<PlannedMove> move;
  if (self->drains) {
    move = leave(servers, sessions, own);
  } else if (calm && self->capacity > 0) {
    move = spread(now, servers, sessions, own);
    if (!move) move = relieve(now, servers, sessions, own);
  }
  if (!move) return std::nullopt;
  const PlacedSession& moving = *std::ranges::find(sessions, move->session, &PlacedSession::session);
  sent_.push_back({now, move->server, moving.cost, moving.expected});
  moved_[move->session] = now;
  if (move->why == PlannedMove::Why::kStrain) relieved_ = now;
  return move;
}

std::optional<PlannedMove> MovePlanner::leave(std::span<const Candidate> servers,
                                              std::span<const PlacedSession> sessions, std::string_view own) {
  for (const bool waiting : {true, false})
    for (const PlacedSession& session : sessions) {
      if (session.waiting != waiting) continue;
      std::vector<std::size_t> fitting;
      for (std::size_t n = 0; n < servers.size(); ++n)
        if (servers[n].server != own && takes_sessions(servers[n]) &&
            servers[n].used + session.cost <= servers[n].capacity)
          fitting.push_back(n);
      if (const auto to = placement_.less_used_of_two(servers, fitting, session.cost))
        return PlannedMove{session.session, servers[*to].server, PlannedMove::Why::kDrain};
    }
  return std::nullopt;
}

std::optional<PlannedMove> MovePlanner::spread(Time now, std::span<const Candidate> servers,
                                               std::span<const PlacedSession> sessions, std::string_view own) {
  const std::vector<Candidate> full = when_all_seats_are_taken(servers);
  const Candidate& self = *std::ranges::find(full, own, &Candidate::server);
  for (const PlacedSession* session : dearest_first(sessions, [&](const PlacedSession& s) {
         return s.waiting && !s.pinned && now - s.opened >= kWaitingRest && !moved_.contains(s.session);
       })) {
    std::vector<std::size_t> fitting;
    for (std::size_t n = 0; n < full.size(); ++n) {
      if (full[n].server == own || !takes_sessions(full[n])) continue;
      const double after = (full[n].used + session->expected) / full[n].capacity;
      if (self.used / self.capacity - after >= session->expected / (2 * self.capacity)) fitting.push_back(n);
    }
    if (const auto to = placement_.less_used_of_two(full, fitting, session->expected))
      return PlannedMove{session->session, full[*to].server, PlannedMove::Why::kSpread};
  }
  return std::nullopt;
}

std::optional<PlannedMove> MovePlanner::relieve(Time now, std::span<const Candidate> servers,
                                                std::span<const PlacedSession> sessions, std::string_view own) {
  if (relieved_ && now - *relieved_ < kBetweenStrained) return std::nullopt;
  const Candidate& self = *std::ranges::find(servers, own, &Candidate::server);
  const double use = self.used / self.capacity, mean = mean_use(servers);
  if (use <= kBusy || use <= kAbove * mean) return std::nullopt;
  for (const PlacedSession* session : dearest_first(sessions, [&](const PlacedSession& s) {
         return !s.waiting && !s.pinned && now - s.opened >= kRest && !moved_.contains(s.session);
       })) {
    std::vector<std::size_t> fitting;
    for (std::size_t n = 0; n < servers.size(); ++n)
      if (servers[n].server != own && takes_sessions(servers[n]) &&
          (servers[n].used + session->cost) / servers[n].capacity <= mean)
        fitting.push_back(n);
    if (const auto to = placement_.less_used_of_two(servers, fitting, session->cost))
      return PlannedMove{session->session, servers[*to].server, PlannedMove::Why::kStrain};
  }
  return std::nullopt;
}

}  // namespace tandem::directory
