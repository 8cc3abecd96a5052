#include "tests/netsim/engine/decision_matrix.h"

#include <algorithm>
#include <array>

#include "netsim/profiles/profile_loader.h"
#include "tests/netsim/support.h"

namespace tandem::netsim::test {
namespace {

struct Shot {
  Time at;
  std::uint32_t link = 0;
  Direction direction = Direction::kUp;
  std::size_t size = 0;
};

/// Returns all datagrams to send, by time. Those of a link depend only on its own traffic.
std::vector<Shot> shots(const std::vector<Traffic>& traffic) {
  std::vector<Shot> all;
  for (std::uint32_t link = 0; link < traffic.size(); ++link) {
    const Traffic& t = traffic[link];
    const RandomKey key = RandomKey{t.seed}.derive(link);
    const auto count = static_cast<std::uint64_t>(t.length / t.period);
    for (std::uint64_t i = 0; i < 2 * count; ++i) {
      const auto moved = static_cast<std::int64_t>(key.bits(2 * i) % static_cast<std::uint64_t>(t.moved.count() + 1));
      all.push_back({Time{t.period * static_cast<std::int64_t>(i / 2) + Duration{moved}}, link,
                     static_cast<Direction>(i % 2), t.size_min + key.bits(2 * i + 1) % (t.size_max - t.size_min + 1)});
    }
  }
  std::ranges::stable_sort(all, {}, &Shot::at);
  return all;
}

/// Returns the time at which the last sender ends. Compared logs end together, independent of other clients.
Time end_of(const std::vector<Traffic>& traffic) {
  Time end{};
  for (const Traffic& t : traffic) end = std::max(end, Time{t.length});
  return end;
}

/// Rows for both directions, their copies and a reserve.
std::size_t room_for(const std::vector<Shot>& all) { return 2 * all.size() + 16; }

LinkSpec both(const PathSpec& path) { return {path, path}; }

std::vector<Decision> log_with(const LinkSpec& link, std::uint64_t seed = 1) {
  Network network{seed};
  network.add_link(link);
  network.add_link(link);
  return log_of(network, {{.seed = 1}, {.period = 2ms, .size_max = 1200, .seed = 2}});
}

/// Script in which all kinds of events occur within five seconds.
std::vector<NetworkEvent> bad_day() {
  const auto profile = shipped_profile("wifi-busy");
  return {{.at = 1s, .link = profile ? profile->link : LinkSpec{}},
          {.at = 1500ms, .clients = {"2"}, .outage = OutageSpec{.length = 200ms, .mode = OutageSpec::Mode::kHold}},
          {.at = 2s, .direction = Direction::kUp, .link = both(everything())},
          {.at = 2500ms, .rebind = Rebind{80ms}},
          {.at = 3s, .outage = OutageSpec{.length = 400ms}},
          {.at = 4s, .link = link_from({.delay = 3ms, .jitter = 2ms, .reorder = 0.05})}};
}

std::vector<Decision> log_of_bad_day() {
  Network network{5};
  for (std::uint64_t i = 0; i < 3; ++i) {
    network.add_link(schedule_for(link_from({.delay = 8ms}), bad_day(), std::to_string(i + 1)), i);
  }
  return log_of(network, {{.seed = 1}, {.seed = 2}, {.seed = 3}});
}

std::vector<Decision> log_of_replay() {
  const auto recorded = Replay::make(log_with(both(everything())));
  if (!recorded) return {};
  Network network{1};
  network.add_replay(std::make_shared<const Replay>(*recorded), 1);
  return log_of(network, {{.period = 700us, .length = 8s, .seed = 9}});
}

}  // namespace

std::vector<Decision> log_of(Network& network, const std::vector<Traffic>& traffic) {
  const auto all = shots(traffic);
  DecisionLog log{room_for(all)};
  network.log_to(&log);
  std::array<std::byte, kSlotBytes> buffer;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Shot& shot = all[i];
    network.send(shot.at, shot.link, shot.direction, datagram(i, shot.size));
    while (network.poll_any(shot.at, buffer)) {
    }
  }
  while (network.poll_any(end_of(traffic), buffer)) {
  }
  network.log_in_flight();
  network.log_to(nullptr);
  return log.sorted();
}

std::vector<Decision> log_of(ProxyCore& core, const std::vector<Traffic>& traffic) {
  const auto all = shots(traffic);
  DecisionLog log{room_for(all)};
  core.log_to(&log);
  for (std::size_t i = 0; i < traffic.size(); ++i) static_cast<void>(core.add_client());
  std::vector<std::uint32_t> heard(traffic.size());  // per client, the newest address received by the server
  const auto drain = [&](Time now) {
    while (const auto egress = core.take(now)) {
      auto& newest = heard[egress->client];
      if (egress->direction == Direction::kUp) newest = std::max(newest, egress->address);
      core.done(*egress);
    }
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Shot& shot = all[i];
    core.ingress(shot.at, shot.link, shot.direction, datagram(i, shot.size), heard[shot.link]);
    drain(shot.at);
  }
  drain(end_of(traffic));
  core.log_in_flight();
  core.log_to(nullptr);
  return log.sorted();
}

std::string difference(const std::vector<Decision>& a, const std::vector<Decision>& b) {
  const std::string first = decision_csv(a), second = decision_csv(b);
  if (first == second) return {};
  const auto [x, y] = std::ranges::mismatch(first, second);
  const auto line = [](const std::string& text, std::size_t at) {
    const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    return begin >= text.size() ? "the end" : text.substr(begin, text.find('\n', begin) - begin);
  };
  return line(first, static_cast<std::size_t>(x - first.begin())) + " | " +
         line(second, static_cast<std::size_t>(y - second.begin()));
}

std::vector<Decision> of_flow(const std::vector<Decision>& rows, std::uint32_t flow) {
  std::vector<Decision> own;
  std::ranges::copy_if(rows, std::back_inserter(own), [flow](const Decision& d) { return d.flow == flow; });
  return own;
}

PathSpec late_decisions() {
  PathSpec spec = everything();
  spec.rate = {.bits_per_s = 1'500'000, .queue_wait = 30ms, .drop = RateSpec::Drop::kHead};
  spec.outages = {{.start = 1s, .length = 150ms, .period = 2s, .mode = OutageSpec::Mode::kHoldLast}};
  spec.corruption = {.probability = 0.05, .mode = CorruptionSpec::Mode::kBitFlips, .bits = 3};
  spec.mtu = {.bytes = 600, .above = MtuSpec::Above::kFragment};
  return spec;
}

std::vector<MatrixEntry> decision_matrix() {
  std::vector<MatrixEntry> all;
  for (const EmbeddedFile& shipped : shipped_profiles()) {
    const auto profile = shipped_profile(shipped.name);
    // A profile that plays a user's recording cannot be simulated without it.
    if (!profile || !problems(profile->link.up).empty() || !problems(profile->link.down).empty()) continue;
    all.push_back({std::string(shipped.name), [link = profile->link] { return log_with(link); }});
  }
  all.push_back({"everything", [] { return log_with(both(everything())); }});
  all.push_back({"everything, seed 2", [] { return log_with(both(everything()), 2); }});
  PathSpec free = everything();
  free.order = ArrivalOrder::kFree;
  all.push_back({"everything, free order", [free] { return log_with(both(free)); }});
  all.push_back({"late decisions", [] { return log_with(both(late_decisions())); }});
  PathSpec cut = late_decisions();
  cut.corruption.mode = CorruptionSpec::Mode::kTruncate;
  cut.rate.drop = RateSpec::Drop::kTail;
  all.push_back({"cut short", [cut] { return log_with(both(cut)); }});
  all.push_back({"a link that two share",
                 [] { return log_with({.up = everything(), .down = late_decisions(), .shared = true}); }});
  all.push_back({"script", log_of_bad_day});
  all.push_back({"replay of other traffic", log_of_replay});
  all.push_back({"proxy", [] {
                   ProxyCore core{both(everything()), 1, bad_day()};
                   return log_of(core, {{.seed = 1}, {.seed = 2}});
                 }});
  return all;
}

}  // namespace tandem::netsim::test
