#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "common/base/rng.h"
#include "common/control/channel.h"
#include "common/control/ipc.h"
#include "tests/common/base/counts.h"
#include "tests/common/control/hostile_network.h"

/// One oracle for all laws: the energy that the motors of a hand give, measured at the hand, over hostile networks. It
/// reads positions and forces alone, no account of a law.
namespace tandem::control {
namespace {

using test::Enemy;
using test::kDof;
using test::kT;

constexpr double kCoupling = 360;  ///< k_c [N/m]

/// A hand on the handle of a device, one axis: a mass on a spring to where the hand wants to be. The motor's force is
/// held during a tick, and the handle moves in steps of a tenth of it.
struct Hand {
  double m = 0.2, b = 2, k = 100;
  double q = 0, v = 0, wish = 0;
  double motor_work = 0;    ///< given by the motor [J]
  double sampled_work = 0;  ///< of it, what holding the force of a spring k_c over a tick creates: 1/2 k_c dq^2 [J]

  void step(double motor) {
    constexpr int kParts = 10;
    const double before = q;
    for (int i = 0; i < kParts; ++i) {
      v += kT / kParts * (motor - b * v + k * (wish - q)) / m;
      q += kT / kParts * v;
    }
    motor_work += motor * (q - before);
    sampled_work += 0.5 * kCoupling * (q - before) * (q - before);
  }
};

struct Outcome {
  double excess = -std::numeric_limits<double>::infinity();  ///< energy given beyond what was taken and the sum of E_0
                                                             ///< [J], worst instant
  double moved = 0;                                          ///< largest distance of the tool from its start [m]
  bool finite = true;
};

/// @param delay  constant delay [ticks]; 0: hostile networks
Outcome play(std::string_view law, std::uint64_t seed, int ticks, int delay = 0) {
  RandomStream random{mix64(seed)};
  ChannelParams p;
  p.dof = kDof;
  p.e0 = 0.01;
  p.effort_max = 3.3;
  p.side = Side::kClient;
  const auto client = make_channel_end(law, p);
  p.side = Side::kServer;
  const auto server = make_channel_end(law, p);
  Enemy up(mix64(seed + 17)), down(mix64(seed + 1000003));
  if (delay > 0) up = Enemy(seed, delay), down = Enemy(seed, delay);
  std::array<MasterIpc, kDof> ipc{};
  std::array<ToolIpc, kDof> tool{};
  std::array<Hand, kDof> hands{};
  for (Hand& hand : hands) {
    hand.m = random.uniform(0.08, 0.5);
    hand.b = random.uniform(0.1, 5);
    hand.k = random.below(3) == 0 ? 0 : random.uniform(20, 800);
    hand.v = random.uniform(-0.3, 0.3);
  }
  const double wall = random.below(2) == 0 ? 0 : random.uniform(50, 5000);
  client->engage({}, 0.05);
  server->engage({}, 0.05);
  EndInput at_client, at_server;
  double client_age = 0.05, server_age = 0.05;
  Outcome worst;
  for (int now = 0; now < ticks; ++now) {
    client_age += kT;
    if (const auto got = down.receive(now)) {
      at_client.rx = *got;
      client_age = down.age_at_arrival;
    }
    at_client.dt = kT;
    at_client.age = client_age;
    for (std::size_t a = 0; a < kDof; ++a) {
      at_client.x[a] = ipc[a].x;
      at_client.dissipated[a] = ipc[a].dissipated;
    }
    const EndState& c = client->move(at_client);
    PortSample sample;
    for (std::size_t a = 0; a < kDof; ++a) {
      client->credit(a, c.absorbed[a]);
      const MasterIpc::Gains gains{kCoupling, 0.5, 0.02};
      ipc[a].step(gains, kT, hands[a].q, c.ref[a], c.k[a], c.b[a]);
      if (random.below(1500) == 0) hands[a].wish = random.uniform(-0.1, 0.1);
      hands[a].step(ipc[a].device_effort(gains, hands[a].q));
      sample.x[a] = ipc[a].x;
      sample.v[a] = ipc[a].v;
      sample.f[a] = c.k[a] * (ipc[a].x - c.ref[a]);
    }
    client->replace_velocity(sample.v);
    sample.e_in = client->e_in();
    up.send(now, sample);

    server_age += kT;
    if (const auto got = up.receive(now)) {
      at_server.rx = *got;
      server_age = up.age_at_arrival;
    }
    at_server.dt = kT;
    at_server.age = server_age;
    for (std::size_t a = 0; a < kDof; ++a) {
      at_server.x[a] = tool[a].x;
      at_server.dissipated[a] = tool[a].dissipated;
    }
    const EndState& s = server->move(at_server);
    for (std::size_t a = 0; a < kDof; ++a) {
      server->credit(a, s.absorbed[a]);
      ToolIpc::Pull pull;
      pull.spring(s.k[a], s.ref[a]);
      pull.spring(wall, 0);
      pull.damper(s.b[a], 0);
      tool[a].step({0.05, 0.2}, kT, pull, s.k[a]);
      sample.x[a] = tool[a].x;
      sample.v[a] = tool[a].v;
      sample.f[a] = s.k[a] * (s.ref[a] - tool[a].x);
      worst.moved = std::max(worst.moved, std::abs(tool[a].x));
      worst.finite &= std::isfinite(tool[a].x) && std::isfinite(hands[a].q);
    }
    server->replace_velocity(sample.v);
    sample.e_in = server->e_in();
    down.send(now, sample);

    double given = -2.0 * kDof * p.e0;
    for (const Hand& hand : hands) given += hand.motor_work - hand.sampled_work;
    worst.excess = std::max(worst.excess, given);
  }
  return worst;
}

class PassiveLaw : public testing::TestWithParam<const char*> {};

TEST_P(PassiveLaw, GivesAHandNoMoreThanItsInitialEnergyOnAnyNetwork) {
  ASSERT_TRUE(make_channel_end(GetParam(), {})->guarantees().ledger);
  const std::uint64_t last = test::seeds(500);
  double moved = 0, worst = -1;
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    const Outcome outcome = play(GetParam(), seed, 3000);
    ASSERT_LE(outcome.excess, 1e-9);
    ASSERT_TRUE(outcome.finite);
    moved = std::max(moved, outcome.moved);
    worst = std::max(worst, outcome.excess);
  }
  EXPECT_GT(moved, 0.02) << "a channel that never moves keeps every promise";
  RecordProperty("worst_excess_j", std::to_string(worst));
}
INSTANTIATE_TEST_SUITE_P(Laws, PassiveLaw, testing::Values("set_position", "tdpa", "wave"),
                         [](const auto& law) { return std::string(law.param); });

TEST(RawChannel, GivesAHandEnergyThatNoEndPaidFor) {  // negative control: the test above can fail
  EXPECT_FALSE(make_channel_end("raw", {})->guarantees().ledger);
  int broken = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) broken += play("raw", seed, 3000).excess > 0.01 ? 1 : 0;
  EXPECT_GE(broken, 10);
}

TEST(PdChannel, IsPassiveAtConstantDelay) {
  EXPECT_FALSE(make_channel_end("pd", {})->guarantees().ledger) << "delays may vary";
  const std::uint64_t last = test::seeds(60);
  for (const int delay : {1, 5, 20, 50, 100, 200, 500}) {
    SCOPED_TRACE(delay);
    int raw_broken = 0;
    for (std::uint64_t seed = 1; seed <= last; ++seed) {
      EXPECT_LE(play("pd", seed, 3000, delay).excess, 1e-9) << seed;
      raw_broken += play("raw", seed, 3000, delay).excess > 0.01 ? 1 : 0;
    }
    if (delay >= 20) {
      EXPECT_GE(raw_broken, 10) << "the same hands over the same delay show what the damping is for";
    }
  }
}

}  // namespace
}  // namespace tandem::control
