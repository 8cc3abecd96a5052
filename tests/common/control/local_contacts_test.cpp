// Surfaces received from the server: how they begin, move and end at a tool, and which energy pays for them.
#include "common/control/local_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/rng.h"
#include "common/control/channel_replica.h"
#include "common/control/tool_copy.h"
#include "tests/common/base/counts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001, kVApp = 0.1;

/// Surface that fills the space beyond x = `at`.
LocalContact wall(double at, float k = 20000, std::uint32_t id = 1) {
  LocalContact c{.id = id, .k = k, .b = 5};
  c.point[0] = static_cast<float>(at);
  c.normal[0] = -1;
  return c;
}
AxisArray at(double x) {
  AxisArray a{};
  a[0] = x;
  return a;
}
ChannelParams channel(double e0, std::size_t axes) {
  ChannelParams p;
  p.dof = axes;
  p.e0 = e0;
  p.effort_max = 3.3;
  return p;
}

/// One hand that leads alone, its copy and its end. The gate gives all of the wanted effort.
struct Seat {
  explicit Seat(double e0 = 0.05, std::size_t axes = 1) : copy(params(axes)), end(channel(e0, axes)) { rest(0, 0); }
  static ToolCopy::Params params(std::size_t axes) {
    ToolCopy::Params p;
    p.axes = axes;
    p.force_max = 10;
    return p;
  }
  void rest(double tool, double hand) {
    copy.rest_at(at(tool), at(hand));
    end.engage(at(tool), 0);
  }
  AxisArray tick(const AxisArray& hand) {
    EndInput in;
    for (std::size_t a = 0; a < end.dof(); ++a) {
      in.x[a] = copy.tool().x(a);
      in.dissipated[a] = copy.dissipated(a);
    }
    in.authority = 1;
    end.move(in);
    const AxisArray wanted = copy.step(hand, 1, end);
    copy.delivered(wanted);
    return wanted;
  }
  double tick(double hand) { return tick(at(hand))[0]; }
  void hear(const LocalContact& contact) { copy.update_contacts({&contact, 1}); }
  ToolCopy copy;
  ReplicaReference end;
};

TEST(LocalContacts, RenderLikeSceneSurfaces) {
  Seat seat;
  seat.rest(-0.002, -0.002);
  double force = 0;
  for (int i = 0; i < 3000; ++i) {
    seat.hear(wall(0));
    force = seat.tick(std::min(0.005, -0.002 + i * 1e-5));
  }
  // Springs in series, 1 / (1/400 + 1/20000) = 392 N/m, over 5 mm. The surface was present before the hand came.
  EXPECT_NEAR(force, -0.005 / (1 / 400.0 + 1 / 20000.0), 1e-3);
  EXPECT_LT(seat.end.ledger(0).out_nj(), 10'000u) << "a surface that stands still does no work";
}

/// Returns the largest change of force between two ticks, while `each` sends surfaces and the hand rests at `hand`.
template <class Each>
double largest_step(Seat& seat, double hand, int ticks, Each&& each) {
  double before = seat.tick(hand), most = 0;
  for (int i = 0; i < ticks; ++i) {
    each(i);
    const double force = seat.tick(hand);
    most = std::max(most, std::abs(force - before));
    before = force;
  }
  return most;
}
/// A surface that moves at v_app moves the spring of the hand by 0.04 N per ms; the tool's own motion adds to it.
constexpr double kStepMax = 1.5 * 400 * kVApp * kT;

TEST(LocalContacts, BeginMoveTurnAndEndWithoutAForceStep) {
  Seat seat(1);
  seat.rest(0.01, 0.01);
  EXPECT_LT(largest_step(seat, 0.01, 500, [&](int) { seat.hear(wall(0)); }), kStepMax) << "begins 10 mm inside";
  EXPECT_NEAR(seat.tick(0.01), -3.92, 0.01) << "and stands there in the end";
  EXPECT_LT(largest_step(seat, 0.01, 500, [&](int) { seat.hear(wall(0.008)); }), kStepMax) << "leaps back";
  EXPECT_NEAR(seat.tick(0.01), -0.784, 0.01);
  EXPECT_LT(largest_step(seat, 0.01, 500, [&](int) { seat.hear(wall(0.002)); }), kStepMax) << "leaps forth";
  EXPECT_LT(largest_step(seat, 0.01, 500, [&](int) { seat.hear(wall(0.002, 500)); }), kStepMax) << "softens";
  EXPECT_NEAR(seat.tick(0.01), -0.008 / (1 / 400.0 + 1 / 500.0), 0.01);
  EXPECT_LT(largest_step(seat, 0.01, 500, [&](int) { seat.hear(wall(0.002)); }), kStepMax) << "stiffens";
  EXPECT_NEAR(seat.tick(0.01), -0.008 / (1 / 400.0 + 1 / 20000.0), 0.01);
  EXPECT_LT(largest_step(seat, 0.01, 500, [](int) {}), kStepMax) << "is not named any more";
  EXPECT_NEAR(seat.tick(0.01), 0, 0.01);
  EXPECT_EQ(seat.copy.received_contacts().surfaces().size(), 0u);
}

TEST(LocalContacts, StayFor100MillisecondsAfterTheLastMessage) {
  Seat seat;
  for (int i = 0; i < 2000; ++i) {
    seat.hear(wall(0));
    seat.tick(std::min(0.005, i * 1e-5));
  }
  const double held = seat.tick(0.005);
  for (int i = 2; i < 100; ++i) ASSERT_NEAR(seat.tick(0.005), held, 1e-6) << i;
  double force = held;
  for (int i = 0; i < 30; ++i) force = seat.tick(0.005);
  EXPECT_GT(force, held + 0.5) << "from then on it retreats";
  seat.hear(wall(0));
  for (int i = 0; i < 90; ++i) force = seat.tick(0.005);
  EXPECT_NEAR(force, held, 0.01) << "named again it comes back";
}

TEST(LocalContacts, MoveAtOnceWhereTheyDoNotPress) {
  LocalContacts contacts({.axes = 1});
  for (const double place : {0.05, -0.03 + 0.04, 0.03}) {
    const LocalContact told = wall(place);
    contacts.update({&told, 1});
    EXPECT_TRUE(contacts.step(at(0), nullptr));
    EXPECT_NEAR(contacts.surfaces()[0].at, -place, 1e-8);
  }
}

TEST(LocalContacts, MoveAtTheApproachSpeedWhereTheyPress) {
  LocalContacts contacts({.axes = 1});
  const LocalContact told = wall(-0.01);
  for (int i = 1; i <= 50; ++i) {
    contacts.update({&told, 1});
    contacts.step(at(0), nullptr);
    ASSERT_NEAR(contacts.surfaces()[0].penetration({0, 0, 0}), i * kVApp * kT, 1e-9);
  }
}

TEST(LocalContacts, TurnAboutTheTool) {
  LocalContacts contacts({.axes = 3});
  LocalContact told = wall(0);
  for (int i = 0; i < 100; ++i) {
    contacts.update({&told, 1});
    contacts.step(at(0.003), nullptr);
  }
  EXPECT_NEAR(contacts.surfaces()[0].penetration({0.003, 0, 0}), 0.003, 1e-8);
  told.normal = {-std::sqrt(0.5F), 0, std::sqrt(0.5F)};
  std::array<double, 3> before = contacts.surfaces()[0].normal;
  for (int i = 0; i < 1000; ++i) {
    contacts.update({&told, 1});
    contacts.step(at(0.003), nullptr);
    const Contact& now = contacts.surfaces()[0];
    double turned = 0, length = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      turned += (now.normal[a] - before[a]) * (now.normal[a] - before[a]);
      length += now.normal[a] * now.normal[a];
    }
    ASSERT_LE(std::sqrt(turned), LocalContacts::kTurn * kT + 1e-9);
    ASSERT_NEAR(length, 1, 1e-12);
    before = now.normal;
  }
  EXPECT_NEAR(before[2], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(contacts.surfaces()[0].penetration({0.003, 0, 0}), 0.003 * std::sqrt(0.5), 1e-8);
}

TEST(LocalContacts, EndBeforeTheirNormalReverses) {
  LocalContacts contacts({.axes = 1});
  LocalContact told = wall(-0.005);
  for (int i = 0; i < 200; ++i) {
    contacts.update({&told, 1});
    contacts.step(at(0), nullptr);
  }
  told.normal[0] = 1;
  told.point[0] = 0.005F;
  double least = 1;
  for (int i = 0; i < 300; ++i) {
    contacts.update({&told, 1});
    const double before = contacts.surfaces()[0].penetration({0, 0, 0});
    contacts.step(at(0), nullptr);
    least = std::min(least, contacts.surfaces()[0].penetration({0, 0, 0}));
    if (contacts.surfaces()[0].normal[0] < 0) {
      ASSERT_LE(before - contacts.surfaces()[0].penetration({0, 0, 0}), kVApp * kT + 1e-12);
    }
  }
  EXPECT_LT(least, 2 * kVApp * kT);
  EXPECT_EQ(contacts.surfaces()[0].normal[0], 1);
  EXPECT_NEAR(contacts.surfaces()[0].penetration({0, 0, 0}), 0.005, 1e-8);
}

TEST(LocalContacts, MoveOnlyAsFarAsTheBudgetAllows) {
  // 10 mm into a spring of 392 N/m would take 19.6 mJ, and 5 mJ are available. The spring then stores 1/2 k d^2 = 5 mJ:
  // 5.05 mm, 1.98 N.
  Seat poor(0.005), none(0), rich(0.05);
  LocalContact undamped = wall(0);
  undamped.b = 0;
  for (Seat* seat : {&poor, &none, &rich}) {
    seat->rest(0.01, 0.01);
    for (int i = 0; i < 2000; ++i) {
      seat->hear(undamped);
      seat->tick(0.01);
    }
  }
  EXPECT_NEAR(poor.tick(0.01), -1.98, 0.1);
  EXPECT_GT(poor.end.refused(), 0.001);
  EXPECT_NEAR(none.tick(0.01), 0, 1e-3);
  EXPECT_NEAR(rich.tick(0.01), -3.92, 0.01);
  EXPECT_EQ(rich.end.refused(), 0);
  EXPECT_NEAR(0.05 - rich.end.ledger(0).margin(), 0.0196, 0.002) << "the energy in the springs was paid";
}

TEST(LocalContacts, SpendFromTheAxesTheyPressAlong) {
  const double r = std::sqrt(0.5);
  Seat seat(0.05, 3);
  LocalContact told = wall(0, 1000);
  told.normal = {static_cast<float>(-r), 0, static_cast<float>(r)};
  AxisArray hand{};
  hand[0] = 0.006;
  seat.copy.rest_at(hand, hand);
  seat.end.engage(hand, 0);
  for (int i = 0; i < 1000; ++i) {
    seat.hear(told);
    seat.tick(hand);
  }
  EXPECT_GT(seat.end.ledger(0).out_nj(), 500'000u);
  EXPECT_NEAR(static_cast<double>(seat.end.ledger(2).out_nj()), static_cast<double>(seat.end.ledger(0).out_nj()),
              1e6 * 0.05);
  EXPECT_LT(seat.end.ledger(1).out_nj(), 1000u);
}

// The energy balance: for any surfaces from the server and any motion of the hand, the motor gives the hand at most the
// paid energy.
TEST(LocalContacts, GiveNoMoreEnergyThanWasPaid) {
  const RandomKey key{7};
  const std::uint64_t cases = test::seeds(200);
  double tightest = 1;
  for (std::uint64_t c = 0; c < cases; ++c) {
    std::uint64_t n = 0;
    const auto draw = [&](double low, double high) { return low + (high - low) * key.derive(c).uniform(n++); };
    Seat seat(0.02);
    const double grip = std::pow(10, draw(-5, -2.5)), hz = draw(0.1, 4), width = draw(0.002, 0.03),
                 k = std::pow(10, draw(2, 5));
    double hand = 0, given = 0, force = 0, unseen = 0, offset = 0;
    for (int i = 0; i < 4000; ++i) {
      if (draw(0, 1) < 0.003) offset = draw(-0.02, 0.02);
      const double next = hand + grip * force + 2e-5 * draw(-1, 1);  // the hand yields, more the looser it is held
      given += force * (next - hand);
      unseen += 0.5 * 400 * (next - hand) * (next - hand);
      hand = next;
      if (draw(0, 1) < 0.9)
        seat.hear(wall(offset - width * std::sin(2 * std::numbers::pi * hz * i * kT), static_cast<float>(k)));
      force = seat.tick(hand);
      ASSERT_TRUE(seat.end.ledger(0).holds());
      const double bound = 1e-9 * static_cast<double>(seat.end.ledger(0).bound_nj());
      ASSERT_LE(given, bound + unseen + 1e-6) << "case " << c << " tick " << i;
      tightest = std::min(tightest, bound + unseen - given);
    }
  }
  EXPECT_LT(tightest, 0.01) << "some hand was given nearly all";
}

TEST(LocalContacts, AreFourAtMost) {
  LocalContacts contacts({.axes = 1});
  for (std::uint32_t id = 1; id <= 5; ++id) {
    const LocalContact told = wall(0.01 * id, 1000, id);
    contacts.update({&told, 1});
  }
  contacts.step(at(0), nullptr);
  EXPECT_EQ(contacts.surfaces().size(), 4u);
  EXPECT_EQ(contacts.dropped(), 1u);
  for (int i = 0; i < 101; ++i) contacts.step(at(0), nullptr);
  EXPECT_EQ(contacts.surfaces().size(), 0u);
  const LocalContact fifth = wall(0.05, 1000, 5);
  contacts.update({&fifth, 1});
  contacts.step(at(0), nullptr);
  EXPECT_EQ(contacts.surfaces().size(), 1u);
}

TEST(LocalContacts, RunWithoutHeap) {
  Seat seat;
  const test::AllocGuard guard;
  for (int i = 0; i < 300; ++i) {
    for (std::uint32_t id = 1; id <= 4; ++id)
      if (i < 100) seat.hear(wall(0.001 * id, 1000, id));
    seat.tick(1e-4 * i);
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::control
