// The hub that the server runs, against the paper's closed form and by hand.
#include "common/control/esc_hub.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::control {
namespace {
constexpr double kDt = 0.001;
EscHub hub_of(std::size_t masters, std::size_t tools, FlowSourceMode mfs = FlowSourceMode::kOpen, double tank = 0.05) {
  return EscHub({.axes = 1, .masters = masters, .tools = tools, .mfs = mfs, .tank = tank, .dt = kDt});
}

/// Opens or cuts the sources of a tool: with the sign that makes the rule passive, injected energy cuts them.
void set_gate(EscHub& hub, std::size_t tool, bool open) { hub.observe(tool, {open ? -1.0 : 1.0}); }

/// All tools at 0 with flow v. @param alpha  A_ji as [tool][master]
void set(EscHub& hub, const std::vector<MasterArray>& alpha, const std::vector<double>& v) {
  for (std::size_t j = 0; j < v.size(); ++j) {
    hub.set_authority(j, alpha[j], false);
    hub.set_tool(j, {.v = {v[j]}, .moved = {v[j] * kDt}});
  }
}

/// End of a seat whose spring exerts F_r on its IPC while all tools are at 0.
EndState end_with(double F_r) {
  EndState end;
  end.k[0] = 1;
  end.ref[0] = -F_r;
  return end;
}

double effort(const EscHub& hub, std::size_t tool, const std::vector<double>& F_r) {
  EscHub::Efforts out{};
  for (std::size_t i = 0; i < F_r.size(); ++i) hub.add_effort(i, tool, end_with(F_r[i]), nullptr, out);
  return out[0].k_anchor - out[0].k * hub.tool(tool).x[0] + out[0].b_velocity;
}

/// Power that the sources of a tool inject, by the observer of eq. 3 and the gate of eq. 4.
double injected(EscHub& hub, std::size_t tool, const std::vector<double>& F_r) {
  const double gate = hub.sources(tool).gate(0), before = hub.sources(tool).energy_p(0);
  AxisArray joule{};
  for (std::size_t i = 0; i < F_r.size(); ++i) hub.add_injected(i, tool, {-F_r[i]}, joule);
  EXPECT_LE(std::abs(joule[0]), 1) << "the gate would move";
  hub.observe(tool, joule);
  return gate * (before - hub.sources(tool).energy_p(0)) / kDt;
}

/// Invariant 8 of ARCHITECTURE.md, for any A, C and gates. The sum of all port powers equals the power injected by the
/// flow sources.
void balances(std::size_t n, std::size_t m, RandomStream& random) {
  EscHub hub = hub_of(n, m, FlowSourceMode::kSeedSigned);
  std::vector<MasterArray> A(m);
  std::vector<double> v(m), F(n);
  for (std::size_t j = 0; j < m; ++j) {
    v[j] = random.uniform(-2, 2);
    set_gate(hub, j, random.below(2) == 0);
    for (std::size_t i = 0; i < n; ++i) {
      A[j][i] = random.uniform();
      hub.set_follow(i, j, random.uniform());
    }
  }
  for (double& f : F) f = random.uniform(-20, 20);
  set(hub, A, v);
  double sum = 0, scale = 1e-9, expected = 0, given = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double power = F[i] * hub.step_target(i, true, {})[0];
    sum += power;
    scale += std::abs(power);
  }
  for (std::size_t j = 0; j < m; ++j) {
    const double power = effort(hub, j, F) * v[j], g = hub.sources(j).gate(0);
    sum += power;
    scale += std::abs(power);
    for (std::size_t i = 0; i < n; ++i) expected += g * (hub.coupling(i, j).follow - A[j][i]) * F[i] * v[j];
    given += injected(hub, j, F);
  }
  scale = std::max(scale, std::abs(expected));
  // The observer holds 1 J, so its differences are rounded to 1e-16 J within a tick of 1 ms.
  EXPECT_NEAR(given, expected, 1e-12 * scale + 1e-12) << n << " masters, " << m << " tools";
  EXPECT_NEAR(sum, expected, 1e-12 * scale) << n << " masters, " << m << " tools";
}

TEST(EscHub, ConservesPowerUpToWhatTheFlowSourcesInject) {
  const std::uint64_t last = test::seeds(200);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    balances(1, 1, random);
    balances(2, 1, random);
    balances(3, 1, random);
    balances(8, 1, random);
    balances(1, 2, random);
    balances(2, 2, random);
    balances(5, 3, random);
    balances(8, 4, random);
    balances(kMastersMax, kToolsMax, random);
  }
}

/// Eq. 1-2 of [Licona et al. 2019] row by row, with all betas. The sources give g v_rs (eq. 4).
struct Printed {
  double v_r1, v_r2, F_rs;
};
Printed printed(double alpha, double g, double v_rs, double F_r1, double F_r2) {
  const bool edge = alpha == 0 || alpha == 1;
  const double beta1 = edge ? alpha : 1;
  const double beta2 = edge ? alpha : 0;
  const double v_s1 = beta1 * v_rs;  // eq. 2
  const double v_s2 = (1 - beta2) * v_rs;
  const double v_sf = g * v_rs;       // eq. 4
  const double T_s1 = -alpha * F_r1;  // eq. 1
  const double T_s2 = (alpha - 1) * F_r2;
  return {alpha * v_s1 + (1 - alpha) * v_sf, (1 - alpha) * v_s2 + alpha * v_sf, beta1 * T_s1 + (1 - beta2) * T_s2};
}

TEST(EscHub, MatchesThePaperForTwoMastersAndOneTool) {
  RandomStream random{1};
  for (int trial = 0; trial < 1000; ++trial) {
    const double alpha = trial % 4 == 0 ? 0 : trial % 4 == 1 ? 1 : random.uniform();
    const double g = static_cast<double>(random.below(2));
    const double v = random.uniform(-1, 1);
    const std::vector<double> F{random.uniform(-5, 5), random.uniform(-5, 5)};
    EscHub hub = hub_of(2, 1, FlowSourceMode::kSeedSigned);
    hub.set_follow(0, 0, 1);
    hub.set_follow(1, 0, 1);
    set_gate(hub, 0, g == 1);
    set(hub, {{alpha, 1 - alpha}}, {v});
    const Printed paper = printed(alpha, g, v, F[0], F[1]);
    EXPECT_NEAR(hub.step_target(0, true, {})[0], paper.v_r1, 1e-15);
    EXPECT_NEAR(hub.step_target(1, true, {})[0], paper.v_r2, 1e-15);
    EXPECT_NEAR(hub.target(0)[0], paper.v_r1 * kDt, 1e-18) << "gates act on the target as increments";
    EXPECT_NEAR(effort(hub, 0, F), paper.F_rs, 1e-14);
  }
}

TEST(EscHub, MovesAFollowerThatDoesNotPush) {
  for (const bool open : {true, false}) {
    EscHub hub = hub_of(2, 1, FlowSourceMode::kSeedSigned);
    hub.set_follow(0, 0, 1);
    hub.set_follow(1, 0, 1);
    set_gate(hub, 0, open);
    set(hub, {{1, 0}}, {0.5});
    EXPECT_EQ(hub.step_target(1, true, {})[0], open ? 0.5 : 0);
    EXPECT_EQ(effort(hub, 0, {2, 100}), -2);
    EXPECT_NEAR(injected(hub, 0, {2, 100}), open ? 50 : 0, 1e-9);
  }
}

TEST(EscHub, IsLosslessInTheWeightedStorageWithOpenGates) {
  RandomStream random{5};
  for (int trial = 0; trial < 200; ++trial) {
    const double a = random.uniform(), v = random.uniform(-1, 1);
    const MasterArray A{a, 0.5 * (1 - a), 0.5 * (1 - a)};
    const std::vector<double> F{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
    EscHub hub = hub_of(3, 1);
    for (std::size_t i = 0; i < 3; ++i) hub.set_follow(i, 0, 1);
    set(hub, {A}, {v});
    double power = effort(hub, 0, F) * v;
    for (std::size_t i = 0; i < 3; ++i) power += A[i] * F[i] * hub.step_target(i, true, {})[0];
    EXPECT_NEAR(power, 0, 1e-14);
  }
}

TEST(EscHub, GivesAnAbsoluteTargetWithoutGates) {
  EscHub hub = hub_of(1, 2);
  hub.set_follow(0, 0, 0.25);
  hub.set_follow(0, 1, 0.75);
  hub.set_tool(0, {.x = {0.04}, .v = {4}});
  hub.set_tool(1, {.x = {0.08}, .v = {8}});
  for (int tick = 0; tick < 3; ++tick) EXPECT_DOUBLE_EQ(hub.step_target(0, true, {})[0], 7);
  EXPECT_DOUBLE_EQ(hub.target(0)[0], 0.07) << "the weighted mean, at every tick";
}

TEST(EscHub, MovesASlaveSeatBeyondTheToolByTheSurfaceForce) {
  EscHub hub = hub_of(1, 2);
  hub.couple_slave(1, 1);
  hub.set_tool(1, {.x = {0.01}, .surface_force = {2}});
  hub.step_target(1, true, {400});
  EXPECT_DOUBLE_EQ(hub.target(1)[0], 0.01 - 0.005);
  NearEnd near;
  hub.find_near_end(1, {400}, near);
  EXPECT_DOUBLE_EQ(near.x[0], 0.005);
  EXPECT_EQ(near.weight, 1);
  EXPECT_EQ(hub.tool(1).slave_goal(0, 0), 0.01) << "without a spring, the tool itself";
}

TEST(EscHub, AttachesOneSpringToTheWeightedMeanOfItsTools) {
  for (const FlowSourceMode mfs : {FlowSourceMode::kOpen, FlowSourceMode::kTank}) {
    EscHub hub = hub_of(2, 2, mfs);
    hub.set_follow(0, 0, 1);
    hub.set_authority(1, {0.5, 0.5}, true);  // not followed, but the seat's spring acts there by its authority
    hub.set_authority(0, {0.5, 0.5}, false);
    hub.set_tool(0, {.x = {0.03}, .dissipated = {0.002}});
    hub.set_tool(1, {.x = {0.06}, .dissipated = {0.004}});
    NearEnd near;
    hub.find_near_end(0, {}, near);
    EXPECT_DOUBLE_EQ(near.weight, 1.5);
    EXPECT_DOUBLE_EQ(near.x[0], (0.03 + 0.5 * 0.06) / 1.5);
    EXPECT_DOUBLE_EQ(near.dissipated[0], mfs == FlowSourceMode::kTank ? 0.001 : 0.002) << "half is the tank's";
    EXPECT_DOUBLE_EQ(near.heat_share, mfs == FlowSourceMode::kTank ? 0.5 : 1);
    EXPECT_TRUE(hub.meets_brake(0));
    EXPECT_TRUE(hub.has_authority(0));
    EXPECT_EQ(hub.authority(0), 0.5);
    hub.set_authority(1, {0, 1}, true);
    EXPECT_FALSE(hub.meets_brake(0)) << "the braked tool does not concern this seat any more";
  }
}

/// The server's end of a spring of 1000 N/m at a tool at 0, whose reference moved from 10 mm to the tool: it absorbed
/// 50 mJ.
std::unique_ptr<ChannelEnd> absorbed_50_mj() {
  ChannelParams p;
  p.side = Side::kServer;
  p.dof = 1;
  p.schedule.k = 1000;
  p.v_app = 1e3;
  auto end = make_channel_end("set_position", p);
  end->engage({0.01}, 0);
  EXPECT_NEAR(end->move({}).absorbed[0], 0.05, 1e-12);
  return end;
}

TEST(EscHub, CreditsWhatAuthorityPaidAndAsksTheSourcesForTheRest) {
  const auto credit_nj = [](EscHub& hub) {
    hub.set_follow(0, 0, 1);
    hub.set_authority(0, {0.25, 0.75}, false);
    const auto end = absorbed_50_mj();
    const std::uint64_t before = end->ledger(0).in_nj();
    hub.settle(0, {0.01}, {}, *end);
    return static_cast<double>(end->ledger(0).in_nj() - before);
  };
  EscHub open = hub_of(2, 1), tank = hub_of(2, 1, FlowSourceMode::kTank, 0.01);
  EXPECT_NEAR(credit_nj(open), 50e6, 3);
  EXPECT_NEAR(open.sources(0).granted(), 0.75 * 0.05, 1e-12);
  EXPECT_NEAR(credit_nj(tank), (0.25 * 0.05 + 0.01) * 1e9, 3) << "no more than the tank held";
  EXPECT_NEAR(tank.sources(0).granted(), 0.01, 1e-12);
}

TEST(EscHub, AsksTheSourcesOfEachToolForItsOwnShare) {
  EscHub hub = hub_of(2, 2);
  hub.set_follow(0, 0, 0.5);
  hub.set_follow(0, 1, 0.5);
  hub.set_authority(0, {0.25, 0.75}, false);
  hub.set_authority(1, {0, 1}, false);
  const auto end = absorbed_50_mj();
  hub.settle(0, {0.01}, {}, *end);
  EXPECT_NEAR(hub.sources(0).granted(), (0.5 - 0.25) * 0.05, 1e-12);
  EXPECT_NEAR(hub.sources(1).granted(), 0.5 * 0.05, 1e-12);
}

/// The server's end of a spring of 1000 N/m at a tool at 0, whose reference moved from the tool to 10 mm: it paid 50
/// mJ.
std::unique_ptr<ChannelEnd> paid_50_mj() {
  ChannelParams p;
  p.side = Side::kServer;
  p.dof = 1;
  p.schedule.k = 1000;
  p.v_app = 1e3;
  p.e0 = 1;
  auto end = make_channel_end("set_position", p);
  end->engage({}, 0);
  EndInput in;
  in.rx.x[0] = 0.01;
  EXPECT_NEAR(end->move(in).paid[0], 0.05, 1e-12);
  return end;
}

TEST(EscHub, FillsTheTankOfTheToolThatTheSeatFollows) {
  for (const std::size_t followed : {0U, 1U}) {
    EscHub hub = hub_of(2, 2, FlowSourceMode::kTank, 1);
    hub.set_follow(0, followed, 1);
    hub.set_authority(followed, {0.25, 0.75}, false);
    hub.settle(0, {}, {}, *paid_50_mj());
    EXPECT_NEAR(hub.sources(followed).tank(), 1 + 0.75 * 0.05, 1e-12)
        << "the part that no authority passes to the tool";
    EXPECT_EQ(hub.sources(1 - followed).tank(), 1);
  }
}

TEST(EscHub, FillsTheTankOfEachToolByItsPartOfTheSpring) {
  EscHub hub = hub_of(2, 2, FlowSourceMode::kTank, 1);
  hub.set_follow(0, 0, 0.5);
  hub.set_follow(0, 1, 0.5);
  hub.set_authority(0, {0.25, 0.75}, false);
  hub.set_authority(1, {0, 1}, false);
  hub.settle(0, {}, {}, *paid_50_mj());
  EXPECT_NEAR(hub.sources(0).tank(), 1 + 0.025 / 2, 1e-12) << "half of its spring drives the tool";
  EXPECT_NEAR(hub.sources(1).tank(), 1 + 0.025, 1e-12);
}

TEST(EscHub, PaysTheDecayOfAnOffsetWithoutAuthority) {
  // The reference is 10 mm ahead of the tool and the offset decays by 0.1 mm away from it: 1000 N/m 10 mm 0.1 mm.
  EscHub hub = hub_of(2, 1);
  hub.set_follow(0, 0, 1);
  hub.set_authority(0, {0.25, 0.75}, false);
  ChannelParams p;
  p.side = Side::kServer;
  p.dof = 1;
  p.schedule.k = 1000;
  const auto end = make_channel_end("set_position", p);
  end->engage({0.01}, 0);
  hub.settle(0, {0.01}, {-0.0001}, *end);
  EXPECT_NEAR(hub.sources(0).granted(), 0.75 * 0.001, 1e-12);
}

TEST(EscHub, CreditsASlaveSeatInFull) {
  EscHub hub = hub_of(1, 1, FlowSourceMode::kTank, 0);
  hub.couple_slave(1, 0);
  const auto end = absorbed_50_mj();
  const std::uint64_t before = end->ledger(0).in_nj();
  hub.settle(1, {0.01}, {}, *end);
  EXPECT_NEAR(static_cast<double>(end->ledger(0).in_nj() - before), 50e6, 1);
}

TEST(EscHub, GrantsAFollowerTheToolsPathTimesItsPull) {
  const auto granted = [](FlowSourceMode mfs, double effort_max, double alpha) {
    EscHub hub = hub_of(2, 1, mfs, 1);
    hub.set_follow(0, 0, 1);
    hub.set_authority(0, {alpha, 1 - alpha}, false);
    hub.set_tool(0, {.x = {0.002}, .moved = {0.0001}});
    ChannelParams p;
    p.side = Side::kServer;
    p.dof = 1;
    p.k_c = 400;
    const auto end = make_channel_end("replica", p);
    hub.grant_following(0, 0, {0}, effort_max, *end);
    EXPECT_NEAR(static_cast<double>(end->ledger(0).in_nj()), hub.sources(0).granted() * 1e9, 1);
    return hub.sources(0).granted();
  };
  EXPECT_NEAR(granted(FlowSourceMode::kTank, 3, 0), 400 * 0.002 * 0.0001, 1e-15);
  EXPECT_NEAR(granted(FlowSourceMode::kOpen, 3, 0), 400 * (0.002 + 0.015 * 0.1) * 0.0001, 1e-15)
      << "with 15 ms of the tool's motion";
  EXPECT_NEAR(granted(FlowSourceMode::kOpen, 1, 0), 1 * 0.0001, 1e-15) << "a motor pulls no harder";
  EXPECT_NEAR(granted(FlowSourceMode::kTank, 3, 0.75), 0.25 * 400 * 0.002 * 0.0001, 1e-15);
  EXPECT_EQ(granted(FlowSourceMode::kOpen, 3, 1), 0) << "a leader pays by its authority";
}

TEST(EscHub, AddsTheSpringOfASlaveSeatByItsShare) {
  const EscHub hub = hub_of(1, 1);
  EndState end;
  end.k[0] = 400;
  end.ref[0] = 0.01;
  end.b[0] = 8;
  end.rate[0] = 0.5;
  EscHub::Efforts out{};
  hub.add_slave_effort(0.25, end, out);
  EXPECT_EQ(out[0].k, 100);
  EXPECT_EQ(out[0].k_anchor, 1);
  EXPECT_EQ(out[0].b, 2);
  EXPECT_EQ(out[0].b_velocity, 1);
}

TEST(EscHub, IsAloneOnlyWhileOneHandWithFullAuthorityFollowsATool) {
  EscHub hub = hub_of(2, 2);
  EXPECT_FALSE(hub.alone(0)) << "no authority is known yet";
  hub.set_follow(0, 0, 1);
  hub.set_follow(1, 1, 1);
  hub.set_authority(0, {1, 0}, false);
  hub.set_authority(1, {0, 0.5}, false);
  EXPECT_TRUE(hub.alone(0)) << "the other hand neither drives nor follows it";
  EXPECT_FALSE(hub.alone(1)) << "half of the authority pays for half of the motion";
  hub.set_authority(0, {0, 0}, true);
  EXPECT_FALSE(hub.alone(0)) << "a hand follows without authority";
  hub.set_authority(0, {1, 0}, false);
  hub.set_follow(1, 0, 1);
  hub.set_authority(0, {1, 0}, false);
  EXPECT_FALSE(hub.alone(0)) << "a second hand follows";
}

/// The server asks no flow source of a tool with one hand alone: they would grant and observe nothing.
TEST(EscHub, GivesNothingToAHandAlone) {
  for (const FlowSourceMode mode : {FlowSourceMode::kOpen, FlowSourceMode::kTank, FlowSourceMode::kSeedSigned}) {
    EscHub hub = hub_of(2, 1, mode);
    hub.set_follow(0, 0, 1);
    hub.set_authority(0, {1, 0}, false);
    hub.set_tool(0, {.x = {0.1}, .v = {2}, .moved = {2 * kDt}});
    ASSERT_TRUE(hub.alone(0));
    AxisArray injected{};
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) hub.add_injected(i, 0, {5}, injected);
    EXPECT_EQ(injected[0], 0);
    ChannelParams params;
    params.side = Side::kServer;
    params.dof = 1;
    const auto end = make_channel_end("replica", params);
    hub.grant_following(0, 0, {-0.3}, 5, *end);
    EXPECT_EQ(hub.sources(0).granted(), 0);
    EXPECT_EQ(end->ledger(0).in_nj(), 0u);
  }
}

}  // namespace
}  // namespace tandem::control
