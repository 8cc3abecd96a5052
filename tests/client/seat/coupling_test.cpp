#include "client/seat/coupling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "client/seat/seat.h"
#include "common/base/rng.h"
#include "common/setup/channel_factory.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::client {
namespace {

constexpr double kT = 0.001;
const AxisArray kStill{};

/// The first seat of the shipped scene `contact` under law REPLICA: a wall at x = 0.
SeatSetup leader() {
  auto scene = parse_scene(find_shipped_scene("contact")->text, "contact");
  scene->channel.law = LawKind::kReplica;
  scene->channel.e0 = ChannelSpec{}.e0;
  scene->tools[0].is_virtual = true;
  scene->tools[0].m_s = 0.02;
  return seat_setup(*scene, 0);
}

/// A device with the client part of its control loop; the gate limits the wanted force to 3.3 N.
struct Hand {
  explicit Hand(const SeatSetup& s)
      : coupling(make_coupling(s)), received(1 + s.further.size()), tools(received.size()) {
    for (std::size_t k = 0; k < tools.size(); ++k) {
      ends.push_back(setup::make_channel(s.channel, control::Side::kClient, s.dof, s.axis_scale, s.gate.force_max,
                                         s.coupling.k_c, true, std::nullopt));
      tools[k] = {ends[k].get(), &received[k]};
    }
  }
  void rest(const AxisArray& q) { coupling->reset({.age = 0.005, .q = q, .v = kStill, .tools = tools}, false); }
  AxisArray tick(double x, double v, double authority, const PortSample& rx, double age) {
    received[0].alpha = authority;
    received[0].port = rx;
    return tick(x, v, age);
  }
  /// Advances by one tick with the received values of each tool in `received`.
  AxisArray tick(double x, double v, double age) {
    const AxisArray place{x}, speed{v};
    AxisArray effort = coupling->step({.dt = kT, .age = age, .q = place, .v = speed, .tools = tools});
    const double norm = std::hypot(effort[0], effort[1], effort[2]);
    for (double& f : effort) f *= norm > 3.3 ? 3.3 / norm : 1;
    coupling->set_delivered(effort);
    return effort;
  }
  [[nodiscard]] PortSample tells(std::size_t k = 0) const {
    PortSample out;
    coupling->fill_sample(k, {.q = kStill, .v = kStill, .tools = tools}, true, out);
    return out;
  }
  std::vector<std::unique_ptr<control::ChannelEnd>> ends;
  std::unique_ptr<Coupling> coupling;
  std::vector<wire::ToolForce> received;
  std::vector<Coupling::Tool> tools;
};

/// Random values that a server can send about other participants, plausible or not.
PortSample said(RandomKey key, std::uint64_t number) {
  PortSample rx;
  std::uint64_t n = 20 * number;
  for (std::size_t a = 0; a < 3; ++a) {
    rx.x[a] = 0.2 * (key.uniform(n++) - 0.5);
    rx.v[a] = 2 * (key.uniform(n++) - 0.5);
    rx.f[a] = 10 * (key.uniform(n++) - 0.5);
    rx.a[a] = 10 * (key.uniform(n++) - 0.5);
    rx.e_in[a] = key.bits(n++) >> 30;
  }
  return rx;
}

struct Differences {
  int force = 0, sample = 0;
};
/// Runs two devices with the same motion and different received values, in free motion and in contact. Returns the
/// number of ticks at which their forces, or their samples, differ in any bit.
Differences between_two_servers(double authority, std::uint64_t seed) {
  const SeatSetup s = leader();
  const RandomKey key{seed};
  Hand one{s}, other{s};
  AxisArray start{};
  start[0] = -0.02;
  one.rest(start);
  other.rest(start);
  PortSample quiet, wild;
  quiet.x = start;
  Differences d;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double w = 2 * std::numbers::pi * 0.7, t = kT * static_cast<double>(i);
    const double x = -0.02 * std::cos(w * t), v = 0.02 * w * std::sin(w * t);  // up to 20 mm into bone
    if (i % 40 == 0) wild = said(key, i);
    const double age = 0.005 + 0.25 * key.derive(1).uniform(i);
    const AxisArray a = one.tick(x, v, authority, quiet, 0.005), b = other.tick(x, v, authority, wild, age);
    const PortSample tells_a = one.tells(), tells_b = other.tells();
    d.force += a != b ? 1 : 0;
    d.sample +=
        tells_a.x != tells_b.x || tells_a.v != tells_b.v || tells_a.a != tells_b.a || tells_a.f != tells_b.f ? 1 : 0;
  }
  return d;
}

// The loop of a sole leader is closed at its own client. Values received about others, of any age, change no bit of its
// force or of its samples.
TEST(CopyCoupling, IgnoresServerReferencesAtASeatThatLeadsAlone) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Differences d = between_two_servers(1, seed);
    EXPECT_EQ(d.force, 0) << seed;
    EXPECT_EQ(d.sample, 0) << seed;
  }
  EXPECT_GT(between_two_servers(0.9, 1).force, 1000) << "else the comparison would see nothing";
}

/// The seat above, which also follows a second tool, heavier and without a wall.
SeatSetup on_two_tools(double first) {
  SeatSetup s = leader();
  s.weight = first;
  s.further = {{.tool = 1, .weight = 1 - first, .m_s = 0.05, .b_s = 0.2, .environment = {}}};
  return s;
}
SeatSetup on_the_second(const SeatSetup& both) {
  SeatSetup s = both;
  s.weight = 1;
  s.m_s = both.further[0].m_s;
  s.b_s = both.further[0].b_s;
  s.environment = both.further[0].environment;
  s.further.clear();
  return s;
}

// F = sum_j C_j F_j: 10 mm into bone with C_j = 0.25 gives a quarter of the force. The tool in free motion adds no
// force at rest.
TEST(CopyCoupling, RendersTwoToolsInProportionToTheirShares) {
  const SeatSetup both = on_two_tools(0.25);
  SeatSetup bone = both;
  bone.weight = 1;
  bone.further.clear();
  Hand hand{both}, alone{bone};
  AxisArray start{};
  start[0] = -0.002;
  hand.rest(start);
  alone.rest(start);
  for (wire::ToolForce& received : hand.received) received.alpha = 1;
  alone.received[0].alpha = 1;
  AxisArray felt{}, full{};
  for (int i = 0; i < 6000; ++i) {
    const double x = std::min(-0.002 + 0.01 * kT * i, 0.005);
    felt = hand.tick(x, 0, 0.005);
    full = alone.tick(x, 0, 0.005);
  }
  EXPECT_NEAR(full[0], -0.005 * both.coupling.k_c * 20000 / (both.coupling.k_c + 20000), 0.02);
  EXPECT_NEAR(felt[0], 0.25 * full[0], 0.002);
}

// Twin test with two seats that each follow one of the tools: each copy is independent of the other's position and
// energy ledger.
TEST(CopyCoupling, SimulatesCopiesOfSeveralToolsIndependently) {
  const SeatSetup both = on_two_tools(0.3);
  SeatSetup bone = both;
  bone.weight = 1;
  bone.further.clear();
  Hand hand{both}, first{bone}, second{on_the_second(both)};
  AxisArray start{};
  start[0] = -0.006;
  for (Hand* h : {&hand, &first, &second}) h->rest(start);
  const RandomKey key{7};
  double moved = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double w = 2 * std::numbers::pi * 0.5, t = kT * static_cast<double>(i);
    const double x = -0.006 * std::cos(w * t),
                 v = 0.006 * w * std::sin(w * t);  // small enough that the gate clips neither tool alone
    if (i % 50 == 0)
      for (std::size_t k = 0; k < 2; ++k) {
        PortSample& port = hand.received[k].port;
        for (std::size_t a = 0; a < 3; ++a)
          port.x[a] = 0.004 * (key.derive(k).uniform(3 * i + a) - 0.5) + (a == 0 ? x : 0);
        for (std::size_t a = 0; a < 3; ++a) port.e_in[a] += 1'000'000;
        hand.received[k].alpha = i < 2000 ? 0.6 : 0;
      }
    first.received[0] = hand.received[0];
    second.received[0] = hand.received[1];
    const AxisArray felt = hand.tick(x, v, 0.03), one = first.tick(x, v, 0.03), other = second.tick(x, v, 0.03);
    for (std::size_t a = 0; a < 3; ++a) ASSERT_NEAR(felt[a], 0.3 * one[a] + 0.7 * other[a], 1e-12) << i;
    ASSERT_EQ(hand.tells(0).x, first.tells().x) << i;
    ASSERT_EQ(hand.tells(1).x, second.tells().x) << i;
    moved = std::max(moved, std::abs(one[0] - other[0]));
  }
  EXPECT_GT(moved, 0.1) << "else both tools do the same";
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_EQ(hand.ends[0]->ledger(a).out_nj(), first.ends[0]->ledger(a).out_nj());
    EXPECT_EQ(hand.ends[1]->ledger(a).out_nj(), second.ends[0]->ledger(a).out_nj());
  }
}

// Two tools that move apart pull in opposite directions. No motor gives such forces, so they must not act on the tools.
TEST(CopyCoupling, PullsEachOfSeveralToolsNoHarderThanTheMotor) {
  SeatSetup both = on_two_tools(0.5);
  both.environment = {};
  Hand hand{both};
  hand.rest({});
  double pulled = 0, felt = 0, sum = 0;
  for (int i = 0; i < 8000; ++i) {
    const double way = std::min(0.05, 0.02 * kT * i);
    for (std::size_t k = 0; k < 2; ++k) {
      hand.received[k].port.x[0] = k == 0 ? way : -way;
      for (std::size_t a = 0; a < 3; ++a)
        hand.received[k].port.e_in[a] += 2'000'000;  // 2 mJ per tick: the ledger refuses nothing
    }
    sum = std::abs(hand.tick(0, 0, 0.005)[0]);
    felt = std::max(felt, std::abs(hand.tells(0).f[0]));
    pulled = std::max(pulled, both.coupling.k_c * std::abs(hand.tells(0).x[0] - hand.coupling->tool_copy(0)->x(0)));
  }
  EXPECT_NEAR(felt, 0.05 * both.coupling.k_c, 0.5) << "each is 50 mm away, and the motor gives the difference";
  EXPECT_NEAR(pulled, 3.3, 1e-6);
  EXPECT_NEAR(sum, 0, 0.01);
}

hal::DeviceCaps device(double damping) {
  hal::DeviceCaps caps;
  caps.joints = caps.tip_axes = 3;
  caps.simulated = true;
  caps.axis[0].peak = 3.3;
  caps.damping = damping;
  return caps;
}

TEST(Seat, RendersNoMoreStiffnessThanItsDeviceForAnySetup) {
  const SeatSetup stiff = leader();
  EXPECT_NEAR((Seat{stiff, device(0.05), {transport::Direction::kToServer, 1, 2}}.setup().coupling.k_c), 93, 1e-9);
  EXPECT_NEAR((Seat{stiff, device(2), {transport::Direction::kToServer, 1, 2}}.setup().coupling.k_c), 400, 1e-9);
}

}  // namespace
}  // namespace tandem::client
