#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/base/format.h"
#include "common/base/rng.h"
#include "server/directory/directory.h"
#include "server/directory/lease_times.h"
#include "tests/server/directory/event_queue.h"
#include "tests/server/directory/model_check.h"

namespace tandem::directory::test {

using namespace std::chrono_literals;

inline constexpr Duration kRamp = 200ms;

inline std::string server_name(std::size_t n) { return format("server-%zu", n); }
inline std::string session_name(std::size_t n) { return format("session-%zu", n); }

/// A server's process and machine.
struct Node {
  bool up = false;  ///< its process runs, or is paused
  std::uint64_t incarnation = 0;
  double rate = 1;
  Duration offset{}, wall_offset{};
  Time paused_until{}, cut_store_until{}, cut_clients_until{}, deposed_until{};
  Time last_watch_delivery{};
  std::map<OperationId, OperationId> watches;  ///< at the store -> at the server
  std::vector<Time> last_acted;
  std::vector<Revision> acted_as;  ///< revisions at the begin of a pause; 0: did not act
};

/// Time, chance, servers and their clocks of one run.
class SimulatedWorld {
 protected:
  SimulatedWorld(const Schedule& schedule, Guard removed)
      : schedule_(schedule), removed_(removed), draws_(RandomKey{schedule.seed}.derive(0xd2)) {
    times_.answer_limit = schedule.answer_limit;
    if (removed == Guard::kHold) times_.hold_after = 10s;
    if (removed == Guard::kRamp) times_.ramp = 1ns;
    nodes_.resize(schedule.servers);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      nodes_[n].rate = 1 + schedule.drift[n + 1];
      nodes_[n].offset = draw(0s, 1000s);
      nodes_[n].last_acted.resize(schedule.sessions, Time::min() + 1h);
      nodes_[n].acted_as.resize(schedule.sessions);
    }
  }

  Time now() const { return events_.now(); }
  void at(Time when, std::function<void()> what) { events_.at(when, std::move(what)); }
  void after(Duration wait, std::function<void()> what) { events_.after(wait, std::move(what)); }
  Duration draw(Duration lo, Duration hi) {
    return lo + Duration{static_cast<std::int64_t>(draws_.uniform() * static_cast<double>((hi - lo).count()))};
  }
  bool chance(double p) { return draws_.uniform() < p; }
  bool calm() const { return now() >= Time{} + schedule_.calm; }
  Duration delay(std::size_t n) {
    const bool slow = !calm() && (!schedule_.slow || *schedule_.slow == n);
    return draw(10us, slow ? schedule_.delay_max : std::min<Duration>(20ms, schedule_.delay_max));
  }
  bool lost() { return chance(schedule_.loss) && !calm(); }
  void fail(const std::string& what) {
    if (verdict_.violation.empty()) verdict_.violation = format("%.3f s: %s", seconds(now()), what.c_str());
  }

  bool runs(const Node& node) const { return node.up && now() >= node.paused_until; }
  Time clock(const Node& node) const {
    const Time monotonic =
        Time{} + node.offset +
        Duration{static_cast<std::int64_t>(static_cast<double>(now().time_since_epoch().count()) * node.rate)};
    return removed_ == Guard::kMonotonicClock ? monotonic + node.wall_offset : monotonic;
  }
  bool clients_cut(std::size_t n) const { return now() < nodes_[n].cut_clients_until; }
  void mix(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    verdict_.fingerprint =
        mix64(verdict_.fingerprint ^
              mix64(a ^ mix64(b ^ mix64(c ^ static_cast<std::uint64_t>(now().time_since_epoch().count())))));
  }

  const Schedule& schedule_;
  Guard removed_;
  RandomStream draws_;
  LeaseTimes times_;
  std::vector<Node> nodes_;
  EventQueue events_;
  Verdict verdict_;
};

}  // namespace tandem::directory::test
