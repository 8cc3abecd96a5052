// Frequent key changes in a whole session over a bad network (tests/FAILURES.md).
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "tests/common/base/counts.h"
#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

struct CommandOutcome {
  std::uint64_t up = 0, down = 0;  ///< accepted datagrams
  Duration gap_up{}, gap_down{};   ///< longest time between two accepted datagrams
  std::uint64_t refused = 0, phases = 0;
  std::uint32_t trips = 0;
};

/// A network that loses 10 % of the datagrams and delays each by 1 to 4 ms independently, so that they overtake each
/// other. The effect on a datagram depends on its number alone, so it is equal for every policy.
CommandOutcome live(std::uint64_t seed, const transport::RekeyPolicy& rekey) {
  SessionFixture rig("one_axis", 3, rekey);
  struct Datagram {
    bool up;
    Bytes bytes;
  };
  std::multimap<Time, Datagram> under_way;
  const RandomKey random{seed};
  std::array<std::uint64_t, 2> number{};
  bool honest = true;  // until the session runs, because this test is not about joining
  const auto send = [&](bool up, const Bytes& bytes) {
    const std::uint64_t n = 2 * number[up ? 1 : 0]++ + (up ? 1 : 0);
    if (!honest && random.uniform(2 * n) < 0.1) return;
    const auto delay = honest ? Duration{1ms} : Duration{1ms} * (1 + static_cast<int>(4 * random.uniform(2 * n + 1)));
    under_way.emplace(rig.now + delay, Datagram{up, bytes});
  };
  const auto tick = [&] {
    for (; !under_way.empty() && under_way.begin()->first <= rig.now; under_way.erase(under_way.begin())) {
      const Datagram& d = under_way.begin()->second;
      if (d.up)
        rig.session->on_datagram(rig.now, address(1), d.bytes);
      else
        rig.seats[0].core->on_datagram(rig.now, d.bytes);
    }
    for (const Bytes& d : rig.client_tick()) send(true, d);
    for (const auto& [to, d] : rig.server_tick()) send(false, d);
    rig.now += 1ms;
  };
  for (int i = 0; i < 1000; ++i) tick();
  honest = false;
  for (int i = 0; i < 4000; ++i) tick();
  const transport::SecureChannelStats &up = rig.heard(), &down = rig.seats[0].core->link().stats();
  CommandOutcome out{up.accepted,
                     down.accepted,
                     up.longest_gap,
                     down.longest_gap,
                     0,
                     rig.session->seat(0).link()->sending_phase(),
                     rig.seats[0].core->gate().trips()};
  for (const auto* stats : {&up, &down})
    for (const auto count : stats->dropped) out.refused += count;
  EXPECT_EQ(rig.session->state(), wire::SessionState::kRunning);
  return out;
}

// "Rekey under 10 % loss and reordering; forced at every packet boundary in simulation: no gap > 2 ms beyond the loss
// itself."
TEST(Rekey, EveryFewDatagramsUnderLossAndReorderingCostsNothing) {
  const std::uint64_t last = tandem::test::seeds(3);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    const CommandOutcome rare = live(seed, {});
    for (const std::uint64_t packets : {8ULL, 16ULL, 100ULL}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", every " + std::to_string(packets));
      const CommandOutcome often = live(seed, {.packets = packets});
      EXPECT_GT(often.phases, 4500 / (packets + 20)) << "keys did not change";
      EXPECT_LE(often.gap_up, rare.gap_up + 2ms);
      EXPECT_LE(often.gap_down, rare.gap_down + 2ms);
      EXPECT_EQ(often.up, rare.up);
      EXPECT_EQ(often.down, rare.down);
      EXPECT_EQ(often.refused, 0U);
      EXPECT_EQ(often.trips, 0U);
    }
    EXPECT_EQ(rare.phases, 0U);
    EXPECT_EQ(rare.trips, 0U);
  }
}

// Each datagram requests the next key as soon as the peer has confirmed the current one. A key change then falls on
// every place of a step.
TEST(Rekey, AtEveryDatagramCostsNoGapBeyondTheLoss) {
  const std::uint64_t last = tandem::test::seeds(3);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    const CommandOutcome rare = live(seed, {}), often = live(seed, {.packets = 1});
    EXPECT_GT(often.phases, 500U);
    EXPECT_LE(often.gap_up, rare.gap_up + 2ms);
    EXPECT_LE(often.gap_down, rare.gap_down + 2ms);
    EXPECT_EQ(often.trips, 0U);
    std::printf("[ hostile  ] seed %llu: %llu keys, gaps %.0f/%.0f ms (%.0f/%.0f with one key), refused %llu\n",
                static_cast<unsigned long long>(seed), static_cast<unsigned long long>(often.phases),
                1e3 * seconds(often.gap_up), 1e3 * seconds(often.gap_down), 1e3 * seconds(rare.gap_up),
                1e3 * seconds(rare.gap_down), static_cast<unsigned long long>(often.refused));
  }
}

}  // namespace
}  // namespace tandem::server
