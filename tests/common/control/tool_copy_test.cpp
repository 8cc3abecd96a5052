#include "common/control/tool_copy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "common/base/rng.h"
#include "common/control/channel_replica.h"
#include "tests/common/base/counts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;

ToolCopy::Params one_axis(double k_wall = 0) {
  ToolCopy::Params p;
  p.axes = 1;
  if (k_wall > 0) p.contacts.add({.normal = {-1, 0, 0}, .at = 0, .k = k_wall, .b = 5});
  return p;
}
ChannelParams channel(double e0 = 0.05) {
  ChannelParams p;
  p.dof = 1;
  p.e0 = e0;
  p.effort_max = 3.3;
  return p;
}
AxisArray at(double x) {
  AxisArray a{};
  a[0] = x;
  return a;
}

/// One hand, its copy and its end. The gate gives the wanted effort up to `most`.
struct Seat {
  explicit Seat(const ToolCopy::Params& p = one_axis(), double e0 = 0.05) : copy(p), end(channel(e0)) {}
  void engage(double tool, double hand) {
    copy.rest_at(at(tool), at(hand));
    end.engage(at(tool), 0);
  }
  /// @return force on the hand [N]
  double tick(double hand, double authority = 1, double r = 0, double r_velocity = 0, double e_in = 0) {
    EndInput in;
    in.x[0] = copy.tool().x(0);
    in.authority = authority;
    in.rx.x[0] = r;
    in.rx.v[0] = r_velocity;
    in.rx.e_in[0] = static_cast<std::uint64_t>(e_in * 1e9);
    in.dissipated[0] = copy.dissipated(0);
    end.move(in);
    const double wanted = copy.step(at(hand), authority, end)[0];
    const double given = std::clamp(wanted, -most, most);
    copy.delivered(at(given));
    return given;
  }
  ToolCopy copy;
  ReplicaReference end;
  double most = 3.3;
};

TEST(ToolCopy, ReturnsToAMovingHandWithoutHoldingItBack) {
  Seat seat;
  seat.engage(0, 0.05);
  double most = 0, speed = 0;
  for (int i = 1; i <= 1500; ++i) {
    most = std::max(most, std::abs(seat.tick(0.05 + 0.1 * i * kT)));
    if (i > 100) speed = std::max(speed, std::abs(seat.copy.tool().v(0)));
  }
  EXPECT_EQ(seat.copy.offset(0), 0);
  EXPECT_LE(most, 0.3) << "damping towards the hand itself, and not towards the place, took 1.4 N";
  EXPECT_LE(speed, 0.1 + 0.1 + 0.01) << "its own speed, and the approach";
}

TEST(ToolCopy, GivesUpTheElongationThatTheGateHoldsBack) {
  Seat seat;
  seat.engage(0, 0);
  double before = 0;
  for (int i = 1; i <= 20; ++i) before = seat.tick(0.001 * i);
  ASSERT_LT(before, -0.1);
  const double offset = seat.copy.offset(0), margin = seat.end.ledger(0).margin();
  seat.copy.yield(at(0.75));
  EXPECT_NEAR(seat.copy.offset(0) - offset, -0.75 * before / 400, 1e-12) << "the hand is ahead of the tool by so much";
  EXPECT_EQ(seat.end.ledger(0).margin(), margin) << "nothing is credited";
  const double x = seat.copy.tool().x(0);
  EXPECT_LT(std::abs(seat.tick(0.020)), 0.5 * std::abs(before));
  EXPECT_LT(seat.copy.tool().x(0) - x, 1e-3) << "the tool does not jump";
}

TEST(ToolCopy, RendersContactLocallyToALeader) {
  Seat seat(one_axis(20000));
  seat.engage(0, 0);
  double force = 0;
  for (int i = 0; i < 3000; ++i) force = seat.tick(std::min(0.005, i * 1e-5));
  // Springs in series, 1 / (1/400 + 1/20000) = 392 N/m, over 5 mm.
  EXPECT_NEAR(force, -0.005 / (1 / 400.0 + 1 / 20000.0), 1e-3);
  EXPECT_LT(seat.end.ledger(0).out_nj(), 10'000u)
      << "a sole leader pays for the damping relative to its own motion only";
}

TEST(ToolCopy, ReportsWhereTheHandPulls) {
  Seat seat(one_axis(20000));
  seat.engage(0, 0);
  for (int i = 0; i < 3000; ++i) seat.tick(std::min(0.004, i * 1e-5));
  EXPECT_NEAR(seat.copy.anchor(0).x, 0.004, 1e-9) << "the hand itself, where its whole force is given";
  double force = 0;
  for (int i = 0; i < 3000; ++i) force = seat.tick(std::min(0.03, 0.004 + i * 1e-5));
  EXPECT_DOUBLE_EQ(force, -3.3);
  EXPECT_NEAR(seat.copy.anchor(0).x, seat.copy.tool().x(0) + 3.3 / 400, 1e-6) << "no farther than the motor pulls";
  EXPECT_NEAR(seat.copy.tool().surface_force()[0], -3.3, 0.01) << "the copy is pulled by what the hand was given";
}

TEST(ToolCopy, KeepsAnOffsetDuringTheRampAndThenDecaysIt) {
  Seat seat;
  seat.engage(0, 0.02);
  for (int i = 0; i < 500; ++i) EXPECT_EQ(seat.tick(0.02), 0) << "a hand that holds still is pulled nowhere";
  EXPECT_DOUBLE_EQ(seat.copy.offset(0), 0.02);
  double before = 0.02;
  for (int i = 0; i < 1000; ++i) {
    seat.tick(0.02);
    EXPECT_LE(before - seat.copy.offset(0), 0.1 * kT + 1e-12) << "at v_app at most";
    before = seat.copy.offset(0);
  }
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(seat.copy.tool().x(0), 0.02, 0.001) << "the tool came to the hand that leads it";
}

TEST(ToolCopy, PaysForTheDecayOfTheOffsetAtTheForceAfterIt) {
  ToolCopy::Params params = one_axis();
  params.b_rel = 0;  // a sole leader then pays for nothing else
  Seat seat(params);
  seat.engage(0, 0.1);
  double force = 0;
  for (int i = 0; i < 900; ++i) force = seat.tick(0.1);
  ASSERT_LT(force, 0) << "the tool lags behind the place that comes to the hand";
  const std::uint64_t before = seat.end.ledger(0).out_nj();
  seat.tick(0.1 + 0.001);  // 1 m/s
  // The spring is stretched by 1 mm of the hand and 0.1 mm of the decay before the tool moves.
  const double stretch = 0.001 + 1e-4 - force / 400;
  EXPECT_NEAR(1e-9 * static_cast<double>(seat.end.ledger(0).out_nj() - before), 400 * stretch * 1e-4, 2e-9);
}

TEST(ToolCopy, GuidesAFollowerAsFarAsItsBudgetAllows) {
  // No energy is granted: 50 mJ is all. The stored energies 1/2 k (q - y)^2 of the spring and of r are bounded by it.
  Seat poor(one_axis(), 0.05);
  poor.engage(0, 0);
  double given = 0, before = 0;
  for (int i = 0; i < 4000; ++i) {
    const double r = 0.05 * std::sin(2 * std::numbers::pi * 0.5 * i * kT);
    const double hand = before;
    const double force = poor.tick(hand, 0, r, 0.157 * std::cos(2 * std::numbers::pi * 0.5 * i * kT));
    before += 2e-5 * force;  // a hand that yields
    given += force * (before - hand);
  }
  EXPECT_LE(given, 0.05 + 1e-3);
  EXPECT_TRUE(poor.end.ledger(0).holds());
  EXPECT_GT(poor.end.refused(), 0.01);

  Seat rich(one_axis(), 0.05);
  rich.engage(0, 0);
  double worst = 0, hand = 0;
  for (int i = 0; i < 4000; ++i) {
    const double r = 0.05 * std::sin(2 * std::numbers::pi * 0.5 * i * kT);
    hand += 2e-4 * rich.tick(hand, 0, r, 0.157 * std::cos(2 * std::numbers::pi * 0.5 * i * kT), 0.002 * i);
    if (i > 500) worst = std::max(worst, std::abs(hand - r));
  }
  EXPECT_LT(worst, 0.006);
  EXPECT_EQ(rich.end.refused(), 0);
}

// The energy balance of the class, for any motion of the hand. The energy that the motor gives is at most the initial
// energy, the granted energy, the heat, and the energy stored by hand and spring.
TEST(ToolCopy, GivesNoMoreEnergyThanWasPaid) {
  const RandomKey key{77};
  const std::uint64_t cases = test::seeds(200);
  for (std::uint64_t c = 0; c < 2 * cases; ++c) {
    std::uint64_t n = 0;
    const auto draw = [&](double low, double high) { return low + (high - low) * key.derive(c).uniform(n++); };
    ToolCopy::Params params = one_axis(draw(0, 1) < 0.5 ? 0 : std::pow(10, draw(2, 4.5)));
    if (c >= cases) params.numerics.substeps = static_cast<std::uint8_t>(2 + c % 7);  // the account counts every part
    Seat seat(params, 0.05);
    const double tool = draw(-0.02, 0.02);
    double hand = draw(-0.02, 0.02);
    seat.engage(tool, hand);
    const double goes_along =
        draw(0, 1) < 0.5 ? 0 : draw(5e-3, 3e-2);  // [m/s per N]; only a hand that yields takes energy
    double authority = draw(0, 1) < 0.4 ? 0 : draw(0, 1), r = tool, speed = 0, given = 0, received = 0, force = 0,
           unseen = 0;
    const double hz = draw(0.2, 6), width = draw(0, 0.03), phase = draw(0, 6);
    for (int i = 0; i < 3000; ++i) {
      if (draw(0, 1) < 0.002) authority = draw(0, 1);
      const double t = i * kT;
      speed = 0.98 * speed + draw(-0.02, 0.02);
      const double next = hand + kT * (goes_along > 0 ? goes_along * force + 0.1 * speed : speed);
      given += force * (next - hand);
      unseen += 0.5 * 400 * (next - hand) * (next - hand);  // a held force follows a moving spring one tick late
      hand = next;
      received += draw(0, 1e-5);
      r = width * std::sin(2 * std::numbers::pi * hz * t + phase);
      force = seat.tick(hand, authority, r,
                        width * 2 * std::numbers::pi * hz * std::cos(2 * std::numbers::pi * hz * t + phase), received);
      ASSERT_TRUE(seat.end.ledger(0).holds());
      const double bound = 1e-9 * static_cast<double>(seat.end.ledger(0).bound_nj());
      ASSERT_LE(given, bound + unseen + 1e-6) << "case " << c << " tick " << i;
    }
  }
}

// During a silence the gate gives no effort once its tank is empty. Hand and copy then separate without a force. This
// distance never returns as a step of force.
TEST(ToolCopy, ReturnsWithoutAStepAfterSeparationInASilence) {
  for (const double authority : {0.0, 0.5, 1.0}) {
    Seat seat;
    seat.engage(0, 0);
    double r = 0;
    for (int i = 0; i < 1500; ++i) seat.tick(0, authority, r);
    const double most = std::exchange(seat.most, 0);
    for (int i = 0; i < 300; ++i) seat.tick(i * 1e-4, authority, r);  // the hand moves 30 mm
    seat.most = most;
    for (int i = 0; i < 10; ++i)
      EXPECT_LE(std::abs(seat.tick(0.03, authority, r)), 0.1 * 400 * kT * (i + 3))
          << authority << " tick " << i << ": at v_app";
    for (int i = 0; i < 2000; ++i) seat.tick(0.03, authority, r);
    if (authority == 1) {
      EXPECT_NEAR(seat.copy.tool().x(0), 0.03, 0.001) << "and the tool comes to the hand";
    }
  }
}

// A hand that shares authority and cannot pay does not feel the whole motion of the copy. The copy is then pulled only
// by the force that the hand feels.
TEST(ToolCopy, IsPulledByTheRenderedForceOnly) {
  Seat poor(one_axis(), 0.01);
  poor.engage(0, 0);
  double force = 0;
  for (int i = 0; i < 4000; ++i) force = poor.tick(0, 0.5, 0.03, i < 500 ? 1 : 0);
  EXPECT_GT(poor.copy.tool().x(0) - force / 400, 0.001) << "the hand is not shown all of it";
  const EndState& others = poor.end.state();
  EXPECT_NEAR(others.k[0] * (others.ref[0] - poor.copy.tool().x(0)), 0.5 * force, 0.02);
}

// A false velocity of the others pushes by the damping relative to it. Without energy to pay, it moves nothing.
TEST(ToolCopy, LimitsRelativeDampingByItsBudget) {
  Seat poor(one_axis(), 0), rich(one_axis(), 0.05);
  for (Seat* seat : {&poor, &rich}) {
    seat->engage(0, 0);
    for (int i = 0; i < 200; ++i) seat->tick(0, 0.5, 0, 0.5);
  }
  EXPECT_EQ(poor.copy.tool().x(0), 0);
  EXPECT_GT(poor.end.refused(), 0);
  EXPECT_GT(rich.copy.tool().x(0), 0.001);
  EXPECT_GT(rich.end.ledger(0).out_nj(), 1'000'000u);
}

ToolCopy::Params assisted(double k_wall = 0) {
  ToolCopy::Params p = one_axis(k_wall);
  p.assist.force = 1;
  return p;
}

// 20 s near a leader that rests 2 mm from the others' reference. A hand with friction of 0.1 N (0.25 mm of the spring)
// arrives within the remaining error of the pull. A hand that resists gets the bound in addition to its spring force.
TEST(ToolCopy, PullsAFollowerToTheLeadersHandWithABoundedForce) {
  for (const bool resists : {false, true}) {
    Seat seat(assisted());
    seat.engage(0, 0);
    double hand = 0, force = 0, most = 0;
    for (int i = 0; i < 20'000; ++i) {
      seat.copy.set_leader(at(0.002), at(0));
      force = seat.tick(hand, 0, 0, 0);
      most = std::max(most, std::abs(force));
      if (!resists && std::abs(force) > 0.1) hand += 2e-4 * (force - std::copysign(0.1, force)) * 1.0;
    }
    if (resists) {
      EXPECT_NEAR(most, 1, 1e-3) << "the spring gives nothing here, so this is the pull's";
    } else {
      EXPECT_NEAR(hand, 0.002, 0.0005);
    }
    EXPECT_TRUE(seat.end.ledger(0).holds());
  }
}

TEST(ToolCopy, GivesTheAssistPullOnlyAsFarAsPaid) {
  Seat poor(assisted(), 0), rich(assisted(), 0.05);
  for (Seat* seat : {&poor, &rich}) {
    seat->engage(0, 0);
    for (int i = 0; i < 3000; ++i) {
      seat->copy.set_leader(at(0.01), at(0));
      seat->tick(0, 0, 0, 0);
    }
  }
  EXPECT_EQ(poor.copy.assist().force(), 0);
  EXPECT_GT(poor.end.refused(), 0);
  EXPECT_NEAR(rich.copy.assist().force(), 1, 1e-3);
  // Energy stored by the spring at 1 N: F^2 / 2k = 1.25 mJ. At most 2 % more is paid, because each step is paid at its
  // new force.
  const double paid = 1e-9 * static_cast<double>(rich.end.ledger(0).out_nj());
  EXPECT_GE(paid, 1.25e-3 - 1e-9);
  EXPECT_LE(paid, 1.02 * 1.25e-3);
}

TEST(ToolCopy, GivesAnAssistedHandNoMoreEnergyThanWasPaid) {
  const RandomKey key{78};
  const std::uint64_t cases = test::seeds(100);
  for (std::uint64_t c = 0; c < cases; ++c) {
    std::uint64_t n = 0;
    const auto draw = [&](double low, double high) { return low + (high - low) * key.derive(c).uniform(n++); };
    ToolCopy::Params p = assisted(draw(0, 1) < 0.5 ? 0 : std::pow(10, draw(2, 4.5)));
    p.assist.force = draw(0, 3);
    p.assist.in_contact = draw(0, 1) < 0.5;
    Seat seat(p, draw(0, 0.002));
    double hand = 0, given = 0, unseen = 0, force = 0, leader = 0, authority = 0;
    seat.engage(hand, hand);
    const double goes_along = draw(1e-3, 3e-2);  // [m/s per N]
    for (int i = 0; i < 4000; ++i) {
      if (draw(0, 1) < 0.002) leader = draw(-0.03, 0.03);  // as a false ghost would
      if (draw(0, 1) < 0.001) authority = draw(0, 1) < 0.5 ? 0 : draw(0, 1);
      const double next = hand + kT * goes_along * force;
      given += force * (next - hand);
      unseen += 0.5 * 400 * (next - hand) * (next - hand);
      hand = next;
      seat.copy.set_leader(at(leader), at(0));
      force = seat.tick(hand, authority, 0, 0, 0);
      ASSERT_LE(given, 1e-9 * static_cast<double>(seat.end.ledger(0).bound_nj()) + unseen + 1e-6)
          << "case " << c << " tick " << i;
    }
  }
}

TEST(ToolCopy, DelaysTheAssistDuringTheRampAndAtASurface) {
  Seat seat(assisted(20000));
  seat.engage(0.001, 0.001);
  const auto ticks = [&](int n, double r) {
    for (int i = 0; i < n; ++i) {
      seat.copy.set_leader(at(0.01), at(0));
      seat.tick(0, 0, r, 0);
    }
    return seat.copy.assist().force();
  };
  EXPECT_EQ(ticks(499, 0.002), 0) << "the ramp of the gate lasts 0.5 s";
  EXPECT_EQ(ticks(2000, 0.002), 0) << "the copy is pulled 2 mm into the wall";
  EXPECT_GT(ticks(2000, -0.005), 0.9) << "and out of it";
  EXPECT_LT(ticks(2000, 0.002), 0.01);
}

TEST(ToolCopy, RunsWithoutHeap) {
  Seat seat(one_axis(20000));
  seat.engage(0, 0);
  const test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) seat.tick(i * 1e-5, 0.5, 0.001);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::control
