#pragma once

#include "netsim/models/path_spec.h"
#include "tests/netsim/support.h"

namespace tandem::netsim::test {

/// Returns a valid random path: each model is on or off, with parameters that take effect within seconds.
/// @param order  fifo or free; slots require fifo and are off otherwise
[[nodiscard]] inline PathSpec random_path(RandomStream& random, ArrivalOrder order) {
  const auto on = [&] { return random.uniform() < 0.4; };
  const auto ms = [&](double lo, double hi) { return from_seconds(1e-3 * random.uniform(lo, hi)); };
  const auto body = [&] {
    using Kind = BodySpec::Kind;
    BodySpec b{.kind = static_cast<Kind>(random.below(10)),
               .low = ms(0, 1),
               .scale = ms(1, 8),
               .shape = random.uniform(0.6, 3)};
    b.high = b.low + ms(0, 10);
    b.cap = b.scale + ms(1, 60);
    b.sd = ms(0.5, 4);
    b.phases = {{0.75, ms(1, 4)}, {0.25, ms(5, 20)}};
    b.quantiles = {{0, 1ms}, {0.9, 3ms}, {1, 30ms}};
    if (on()) b.tau = ms(1, 100);
    return b;
  };

  PathSpec spec;
  spec.order = order;
  if (on()) spec.outages.push_back({.start = ms(100, 900), .length = ms(20, 300), .period = ms(700, 3000)});
  if (on())
    spec.outages.push_back({.start = ms(0, 900),
                            .length = ms(20, 300),
                            .period = ms(700, 3000),
                            .mode = OutageSpec::Mode::kHold,
                            .hold_bytes = random.below(20'000)});
  if (on())
    spec.outages.push_back(
        {.length = ms(10, 50), .mean_gap = ms(500, 2000), .length_max = ms(50, 200), .scope = OutageSpec::Scope::kAll});
  if (on())
    spec.outages.push_back({.start = ms(0, 900),
                            .length = ms(30, 300),
                            .period = ms(700, 3000),
                            .mode = OutageSpec::Mode::kHoldLast,
                            .loss_at_start = ms(0, 30)});
  LossSpec& loss = spec.loss;
  if (on()) loss.probability = random.uniform(0, 0.2);
  if (on())
    loss.periods = BadPeriodsSpec{.good_mean = ms(100, 1000), .bad_mean = ms(5, 100), .loss_bad = random.uniform()};
  if (on()) loss.gilbert_elliott = GilbertElliottSpec{.p = random.uniform(0.01, 0.1), .r = random.uniform(0.1, 0.9)};
  if (on()) loss.four_state = FourStateSpec{.p13 = 0.05, .p31 = 0.3, .p32 = 0.1, .p23 = 0.5, .p14 = 0.01};
  if (on())
    loss.bursts =
        LossBurstsSpec{.rate_per_s = 1, .law = LossBurstsSpec::Law::kParetoII, .length = 4, .alpha = 1.5, .cap = 80};
  if (on()) loss.pattern = LossPatternSpec{.lost = 1, .of = 50, .every = 77, .indices = {5}, .times = {1s}};
  if (on()) loss.trace = std::make_shared<LossTrace>(LossTrace{{false, false, false, true}, ms(1, 100)});
  if (on()) {
    spec.rate = {.bits_per_s = 300'000 + random.below(3'000'000)};
    if (on()) spec.rate.queue_bytes = 2'000 + random.below(30'000);
    if (on()) spec.rate.queue_wait = ms(20, 300);
    if (on()) spec.rate.queue_datagrams = static_cast<std::uint32_t>(1 + random.below(200));
    if (on()) {
      spec.rate.drop = RateSpec::Drop::kHead;
      if (spec.rate.queue_bytes == 0 && !spec.rate.queue_wait) spec.rate.queue_datagrams = 40;  // required
    } else {
      if (on()) spec.rate.codel = CoDelSpec{};
      if (on()) spec.rate.competing_peak = ms(10, 100), spec.rate.competing_period = ms(200, 2000);
    }
    if (on()) loss.congestion = CongestionLossSpec{.wait_low = ms(1, 10), .wait_high = ms(20, 90), .probability = 0.3};
  } else if (on()) {
    spec.rate.trace = std::make_shared<CapacityTrace>(CapacityTrace{{{0, 1}, {3, 2}, {4, 1}, {40, 5}}, 60ms});
    if (on()) spec.rate.queue_bytes = 2'000 + random.below(30'000);
  }
  spec.floor = ms(0, 20);
  if (on()) spec.trace = std::make_shared<DelayTrace>(DelayTrace{{{0ms, 2ms}, {40ms, 9ms}, {90ms, 1ms, true}}, 100ms});
  if (on()) spec.body = body();
  if (on()) spec.regimes = {{.mean = ms(50, 500)}, {.mean = ms(50, 500), .floor = ms(1, 9), .body = body()}};
  if (on())
    spec.boundary = {.period = ms(300, 2000),
                     .stall_low = ms(1, 20),
                     .stall_high = ms(20, 150),
                     .floor_high = ms(1, 9),
                     .loss_window = ms(1, 20),
                     .loss = 0.3};
  if (on()) {
    spec.stall = {.rate_per_s = random.uniform(0.2, 3), .length_min = ms(2, 20), .alpha = 1.5, .cap = ms(30, 400)};
    if (on()) loss.congestion = CongestionLossSpec{.in_stall = 0.3};
  }
  if (order == ArrivalOrder::kFifo && on())
    spec.slots = {.period = ms(0.5, 8), .datagrams = static_cast<std::uint32_t>(random.below(20))};
  if (on())
    spec.reorder = {.probability = random.uniform(0, 0.1),
                    .displacement = static_cast<std::uint32_t>(1 + random.below(6)),
                    .hold_limit = ms(5, 80)};
  if (on()) spec.duplicate = {.probability = random.uniform(0, 0.2), .delay_max = ms(0, 9)};
  if (on()) {
    spec.corruption.probability = random.uniform(0, 0.1);
    spec.corruption.mode = static_cast<CorruptionSpec::Mode>(random.below(3));
    spec.corruption.bits = static_cast<std::uint32_t>(1 + random.below(8));
  }
  if (on())
    spec.mtu = {.bytes = static_cast<std::uint32_t>(100 + random.below(1400)),
                .above = static_cast<MtuSpec::Above>(random.below(2))};
  return spec;
}

}  // namespace tandem::netsim::test
