#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/format.h"
#include "common/base/rng.h"
#include "tests/server/directory/model_check.h"

namespace tandem::directory::test {

namespace {

using namespace std::chrono_literals;

Duration between(RandomStream& d, Duration lo, Duration hi) {
  return lo + Duration{static_cast<std::int64_t>(d.uniform() * static_cast<double>((hi - lo).count()))};
}

constexpr std::array kNames{"pause",      "suspend",  "crash",         "cut from store", "cut from clients",
                            "wall clock", "election", "deposed",       "outage",         "slow disk",
                            "compaction", "move",     "store emptied", "store put back", "disk lost"};
constexpr std::size_t kOrdinary = 12;  ///< faults without losses

}  // namespace

Schedule draw_schedule(std::uint64_t seed) {
  RandomStream d(RandomKey{seed}.derive(0xd1));
  Schedule out;
  out.seed = seed;
  out.servers = 2 + d.below(3);
  out.sessions = 1 + d.below(2);
  out.loss = d.uniform() < 0.5 ? 0 : d.uniform(0, 0.3);
  out.duplicate = d.uniform() < 0.5 ? 0 : d.uniform(0, 0.3);
  out.delay_max = d.uniform() < 0.5 ? between(d, 1ms, 20ms) : between(d, 20ms, 1500ms);
  out.answer_limit = d.uniform() < 0.5 ? 1s : 3s;
  if (d.uniform() < 0.5) out.slow = d.below(out.servers);
  for (std::size_t n = 0; n <= out.servers; ++n) out.drift.push_back(d.uniform(-0.05, 0.05));
  out.calm = between(d, 8s, 16s);
  for (std::size_t n = d.below(7); n > 0; --n) {
    Fault fault;
    // Loss of the store is the fault that leases are for: as frequent as three others.
    const std::size_t kind = d.below(kOrdinary + 2);
    fault.kind = kind < kOrdinary ? static_cast<Fault::Kind>(kind) : Fault::Kind::kCutStore;
    fault.who = d.below(out.servers);
    fault.to = d.below(out.servers);
    fault.at = between(d, 1s, out.calm);
    fault.length = d.uniform() < 0.5 ? between(d, 1ms, 1s) : between(d, 2s, 6s);
    if (fault.kind == Fault::Kind::kMove) fault.who = d.below(out.sessions);
    fault.length = std::min(fault.length, out.calm - fault.at);
    out.faults.push_back(fault);
  }
  std::ranges::stable_sort(out.faults, {}, &Fault::at);
  return out;
}

Schedule draw_schedule_with_losses(std::uint64_t seed) {
  Schedule out = draw_schedule(seed);
  RandomStream d(RandomKey{seed}.derive(0xd3));
  // A server that was cut off before cannot tell a copy from the present. So the manual demands that a restore takes
  // longer than a lease; if nothing else fails, it may be shorter.
  const bool alone = d.uniform() < 0.3;
  if (alone) {
    // A copy of before the move gives the session to its former owner.
    out.faults = {{Fault::Kind::kMove, d.below(out.sessions), d.below(out.servers), between(d, 1s, 6s), {}, {}}};
    out.loss = 0;
    out.delay_max = std::min<Duration>(out.delay_max, 20ms);
  }
  for (std::size_t n = alone ? 1 : 1 + d.below(2); n > 0; --n) {
    Fault fault;
    fault.kind = d.uniform() < 0.5 ? Fault::Kind::kEmptied : Fault::Kind::kPutBack;
    fault.age = between(d, 1s, kAgeMax);
    const bool back = fault.kind == Fault::Kind::kPutBack && !alone;
    fault.at = between(d, 1s, out.calm - (back ? kRestoreMin : Duration::zero()));
    fault.length = d.uniform() < 0.5 ? between(d, 1ms, 500ms) : between(d, 1s, 5s);
    if (back) fault.length += kRestoreMin;
    fault.length = std::min(fault.length, out.calm - fault.at);
    out.faults.push_back(fault);
    // A server that reaches the new store later than others is where two could act.
    if (d.uniform() < 0.5) {
      Fault cut{Fault::Kind::kCutStore, d.below(out.servers), 0, fault.at, {}, {}};
      cut.length = std::min(fault.length + between(d, 100ms, 6s), out.calm - cut.at);
      out.faults.push_back(cut);
    }
    if (d.uniform() < 0.3) {
      Fault disk{Fault::Kind::kDiskLost, d.below(out.servers), 0, fault.at, {}, {}};
      disk.length = std::min(between(d, 1ms, 6s), out.calm - disk.at);
      out.faults.push_back(disk);
    }
  }
  std::ranges::stable_sort(out.faults, {}, &Fault::at);
  return out;
}

Schedule shrink(Schedule schedule, const std::function<Verdict(const Schedule&)>& run) {
  for (std::size_t n = schedule.faults.size(); n-- > 0;) {
    Schedule fewer = schedule;
    fewer.faults.erase(fewer.faults.begin() + static_cast<std::ptrdiff_t>(n));
    if (!run(fewer).violation.empty()) schedule = fewer;
  }
  for (double Schedule::* noise : {&Schedule::loss, &Schedule::duplicate}) {
    Schedule quieter = schedule;
    quieter.*noise = 0;
    if (!run(quieter).violation.empty()) schedule = quieter;
  }
  return schedule;
}

std::string to_text(const Schedule& s) {
  std::string text =
      format("seed %llu: %zu servers, %zu sessions, loss %.2f, duplicates %.2f, delay up to %.3f s, calm at %.2f s",
             static_cast<unsigned long long>(s.seed), s.servers, s.sessions, s.loss, s.duplicate, seconds(s.delay_max),
             seconds(s.calm));
  for (const Fault& fault : s.faults)
    text += format("\n  %.3f s: %s %zu, %.3f s", seconds(fault.at), kNames[static_cast<std::size_t>(fault.kind)],
                   fault.who, seconds(fault.length));
  return text;
}

const char* to_text(Guard guard) {
  constexpr std::array kTexts{"none",
                              "renewals count from sending",
                              "hold",
                              "ramp",
                              "claim compares",
                              "release compares",
                              "ticket compares",
                              "identity by lease",
                              "owner key under a lease",
                              "renewal confirmed",
                              "confirmed in its term",
                              "monotonic clock",
                              "clock counts suspension",
                              "own key recognised",
                              "standby key under its lease",
                              "clients keep the highest revision"};
  return kTexts[static_cast<std::size_t>(guard)];
}

}  // namespace tandem::directory::test
