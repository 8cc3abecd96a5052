#include "server/policy/shard_plan.h"

#include <algorithm>

namespace tandem::server {
namespace {

// Of a processor that serves 250 clients at 1 kHz (server/README.md). A session without clients costs about one of
// them.
constexpr double kClientTick = 4e-6;  // [s]

struct Rate {
  double tick_hz = 0;
  std::size_t sessions = 0, shards = 1;
  double cost = 0;
};

}  // namespace

double expected_cost(const SessionDemand& session) noexcept {
  return kClientTick * session.tick_hz * static_cast<double>(1 + session.seats);
}

double expected_seat_cost(double tick_hz) noexcept { return kClientTick * tick_hz; }

std::vector<double> shard_rates(std::span<const SessionDemand> sessions, std::size_t threads, std::size_t created_max) {
  std::vector<Rate> rates;
  for (const SessionDemand& session : sessions) {
    auto rate = std::ranges::find(rates, session.tick_hz, &Rate::tick_hz);
    if (rate == rates.end()) rate = rates.insert(rates.end(), {session.tick_hz});
    ++rate->sessions;
    rate->cost += expected_cost(session);
  }
  for (std::size_t shards = rates.size(); shards < threads; ++shards) {
    Rate* most = nullptr;
    for (Rate& rate : rates) {
      if (rate.shards >= rate.sessions + created_max) continue;
      if (most == nullptr ||
          rate.cost * static_cast<double>(most->shards) > most->cost * static_cast<double>(rate.shards))
        most = &rate;
    }
    if (most == nullptr) break;
    ++most->shards;
  }
  std::vector<double> out;
  for (const Rate& rate : rates) out.insert(out.end(), rate.shards, rate.tick_hz);
  return out;
}

std::vector<std::size_t> first_placement(std::span<const SessionDemand> sessions, std::span<const double> rates) {
  std::vector<std::size_t> placed;
  std::vector<double> cost(rates.size());
  for (const SessionDemand& session : sessions) {
    std::size_t best = rates.size();
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (rates[i] == session.tick_hz && (best == rates.size() || cost[i] < cost[best])) best = i;
    placed.push_back(best);
    cost[best] += expected_cost(session);
  }
  return placed;
}

}  // namespace tandem::server
