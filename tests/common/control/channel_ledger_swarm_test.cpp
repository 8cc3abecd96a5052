#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "common/base/rng.h"
#include "common/control/channel.h"
#include "common/control/ipc.h"
#include "tests/common/base/counts.h"
#include "tests/common/control/hostile_network.h"

/// Invariant 6 of ARCHITECTURE.md: two ends of a channel whose network is hostile.
namespace tandem::control {
namespace {

using test::Enemy;
using test::kDof;
using test::kT;

/// One end, with the test's own energy account [J]. The account uses positions and stiffnesses alone and never reads
/// the ledger.
struct End {
  std::unique_ptr<ChannelEnd> channel;
  PortSample rx{};
  double age = 0.15, pass_on = 1;
  std::array<double, kDof> paid{}, absorbed{}, heat{}, received{}, passed{};

  void receive(Enemy& from, int now) {
    age += kT;
    if (const auto sample = from.receive(now)) {
      rx = *sample;
      age = from.age_at_arrival;
      for (std::size_t a = 0; a < kDof; ++a)
        received[a] = std::max(received[a], 1e-9 * static_cast<double>(rx.e_in[a]));
    }
  }
  const EndState& move(const AxisArray& x, const AxisArray& dissipated) {
    const EndState before = channel->state();
    const EndState& s = channel->move(
        {.dt = kT, .age = age, .weight = 1, .x = x, .dissipated = dissipated, .pass_on = pass_on, .rx = rx});
    for (std::size_t a = 0; a < kDof; ++a) {
      heat[a] += dissipated[a];
      const double old_e = before.ref[a] - x[a], new_e = s.ref[a] - x[a];
      for (const double energy :
           {0.5 * (s.k[a] - before.k[a]) * old_e * old_e, 0.5 * s.k[a] * (new_e * new_e - old_e * old_e)})
        (energy > 0 ? paid : absorbed)[a] += std::abs(energy);
      passed[a] += s.passed[a];
      channel->credit(a, s.absorbed[a]);
    }
    return s;
  }
};

struct Worst {
  double overdraft = -1e9;  ///< paid or passed on beyond E_0 + received + eta D [J], any end, axis and sample
  double session = -1e9;    ///< net energy given to both plants beyond the sum of all E_0 and heat [J]
  double credit = -1e9;     ///< energy claimed by e_in beyond the energy really absorbed or passed on [J]
  bool ledger_held = true;
  double moved = 0;  ///< largest distance of the tool from its start [m]; shows that the channel transmits motion
};

Worst play(std::string_view law, std::uint64_t seed, int ticks) {
  RandomStream random{seed};
  ChannelParams p;
  p.dof = kDof;
  if (random.below(2) == 0) p.scale = {0.02, 0.017, 0.012, 1, 1, 1, 1};
  if (random.below(2) == 0) p.schedule.k_min = p.schedule.k;  // constant 1 kN/m, the worst case
  p.v_app = random.below(3) == 0 ? 1e6 : 0.1;
  p.margin_max = random.below(2) == 0 ? 0.1 : 1e6;
  if (random.below(3) == 0) p.effort_max = 3.3;
  if (random.below(2) == 0) p.e0 = random.uniform(0, 0.01);  // a small initial energy makes every violation visible
  if (random.below(3) == 0) p.margin_max = random.uniform(0, 0.01);
  p.side = Side::kClient;
  End client{make_channel_end(law, p)};
  p.side = Side::kServer;
  End server{make_channel_end(law, p)};
  server.pass_on = random.uniform();
  Enemy up(mix64(seed)), down(mix64(seed + 1000003));

  std::array<MasterIpc, kDof> ipc{};
  std::array<ToolIpc, kDof> tool{};
  std::array<double, kDof> q{}, wish{}, reach{};
  const double tip = 1 / std::sqrt(p.scale[0]), environment = random.below(2) == 0 ? 0 : 400,
               b_hand = random.uniform(0, 2);
  for (double& r : reach) r = random.uniform(0.01, 0.2) * tip;
  client.channel->engage({}, 0.15);
  server.channel->engage({}, 0.15);
  Worst worst;
  for (int now = 0; now < ticks; ++now) {
    const auto sample = [now](const End& end, const auto& mass) {
      PortSample s;
      for (std::size_t a = 0; a < kDof; ++a) {
        s.x[a] = mass[a].x;
        s.v[a] = mass[a].v;
        s.f[a] = end.channel->state().k[a] * (mass[a].x - end.channel->state().ref[a]);
      }
      s.e_in = end.channel->e_in();
      (void)now;
      return s;
    };
    AxisArray x{}, heat{};
    // Client: receive, move r, step the IPC with a random strong hand, send.
    client.receive(down, now);
    for (std::size_t a = 0; a < kDof; ++a) {
      if (random.below(300) == 0) wish[a] = random.uniform(-reach[a], reach[a]);
      q[a] += 0.01 * (wish[a] - q[a]);
      x[a] = ipc[a].x;
      heat[a] = ipc[a].dissipated;
    }
    const EndState& c = client.move(x, heat);
    for (std::size_t a = 0; a < kDof; ++a)
      ipc[a].step({400 * p.scale[a], b_hand * p.scale[a], 0.02 * p.scale[a]}, kT, q[a], c.ref[a], c.k[a], c.b[a]);
    up.send(now, sample(client, ipc));
    // Server: receive, move p, step the tool against its environment, send.
    server.receive(up, now);
    for (std::size_t a = 0; a < kDof; ++a) {
      x[a] = tool[a].x;
      heat[a] = tool[a].dissipated;
    }
    const EndState& s = server.move(x, heat);
    for (std::size_t a = 0; a < kDof; ++a) {
      ToolIpc::Pull pull;
      pull.spring(s.k[a], s.ref[a]);
      pull.spring(environment * p.scale[a], 0);
      pull.damper(s.b[a], 0);
      tool[a].step({0.05 * p.scale[a], 0.5 * p.scale[a]}, kT, pull, s.k[a]);
      worst.moved = std::max(worst.moved, std::abs(tool[a].x) / tip);
    }
    down.send(now, sample(server, tool));

    double given = 0, allowed = 0;
    for (const End* end : {&client, &server}) {
      for (std::size_t a = 0; a < kDof; ++a) {
        const double own = p.e0 + p.eta * end->heat[a];
        worst.overdraft = std::max(worst.overdraft, end->paid[a] + end->passed[a] - own - end->received[a]);
        worst.credit = std::max(
            worst.credit, 1e-9 * static_cast<double>(end->channel->e_in()[a]) - end->absorbed[a] - end->passed[a]);
        worst.ledger_held &= end->channel->ledger(a).holds();
        given += end->paid[a] - end->absorbed[a];
        allowed += own;
      }
    }
    worst.session = std::max(worst.session, given - allowed);
  }
  return worst;
}

TEST(SetPosition, NeverGivesMoreEnergyThanItTookOnAnyNetwork) {
  const std::uint64_t last = test::seeds(192);
  double moved = 0;
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    const Worst worst = play("set_position", seed, 4000);
    ASSERT_LE(worst.overdraft, 1e-9);
    ASSERT_LE(worst.session, 1e-9);
    ASSERT_LE(worst.credit, 1e-9);
    ASSERT_TRUE(worst.ledger_held);
    moved = std::max(moved, worst.moved);
  }
  EXPECT_GT(moved, 0.02) << "a channel that never moves keeps every promise";
}

TEST(RawChannel, GivesMoreEnergyThanItTookAsDeclared) {  // negative control: the test above can fail
  int broken = 0, created = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Worst worst = play("raw", seed, 4000);
    broken += worst.overdraft > 0.01 && !worst.ledger_held ? 1 : 0;
    created += worst.session > 0.01 ? 1 : 0;
  }
  EXPECT_GE(broken, 20);
  EXPECT_GE(created, 6);
  EXPECT_FALSE(make_channel_end("raw", {})->guarantees().ledger);
}

}  // namespace
}  // namespace tandem::control
