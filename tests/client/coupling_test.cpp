#include "client/coupling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "client/seat.h"
#include "common/base/rng.h"
#include "common/setup/channel_setup.h"
#include "proto/scene_text.h"
#include "proto/scenes_embedded.h"

namespace tandem::client {
namespace {

constexpr double kT = 0.001;

/// The first seat of the shipped scene `contact` under law REPLICA: a wall at x = 0.
SeatSetup leader() {
  auto scene = parse_scene(find_shipped_scene("contact")->text, "contact");
  scene->channel.law = LawKind::kReplica;
  scene->channel.e0 = ChannelSpec{}.e0;
  scene->tools[0].is_virtual = true;
  scene->tools[0].m_s = 0.02;
  return seat_setup(*scene, 0);
}

/// A hand and all of its loop that is at the client, with a gate that gives what is wanted up to 3.3 N.
struct Hand {
  explicit Hand(const SeatSetup& s)
      : end(setup::make_channel(s.channel, control::Side::kClient, s.dof, s.axis_scale, s.gate.force_max, s.coupling.k_c, true, std::nullopt)), coupling(make_coupling(s)) {}
  AxisArray tick(double x, double v, double authority, const PortSample& rx, double age) {
    Coupling::Input in;
    in.dt = kT;
    in.age = age;
    in.authority = authority;
    in.q[0] = x;
    in.v[0] = v;
    in.rx = &rx;
    AxisArray effort = coupling->step(in, *end);
    const double norm = std::hypot(effort[0], effort[1], effort[2]);
    for (double& f : effort) f *= norm > 3.3 ? 3.3 / norm : 1;
    coupling->delivered(effort);
    return effort;
  }
  std::unique_ptr<control::ChannelEnd> end;
  std::unique_ptr<Coupling> coupling;
};

/// What a server may say of others, true or not.
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
  int felt = 0, told = 0;
};
/// Two hands that move alike and hear different things, in free motion and in contact: ticks at which they feel, or tell, another bit.
Differences between_two_servers(double authority, std::uint64_t seed) {
  const SeatSetup s = leader();
  const RandomKey key{seed};
  Hand one{s}, other{s};
  AxisArray start{};
  start[0] = -0.02;
  one.coupling->rest(start, nullptr, 0.005, *one.end);
  other.coupling->rest(start, nullptr, 0.005, *other.end);
  PortSample quiet, wild;
  quiet.x = start;
  Differences d;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double w = 2 * std::numbers::pi * 0.7, t = kT * static_cast<double>(i);
    const double x = -0.02 * std::cos(w * t), v = 0.02 * w * std::sin(w * t);  // 20 mm into bone
    if (i % 40 == 0) wild = said(key, i);
    const double age = 0.005 + 0.25 * key.derive(1).uniform(i);
    const AxisArray a = one.tick(x, v, authority, quiet, 0.005), b = other.tick(x, v, authority, wild, age);
    PortSample tells_a, tells_b;
    one.coupling->tell(start, start, true, *one.end, tells_a);
    other.coupling->tell(start, start, true, *other.end, tells_b);
    d.felt += a != b ? 1 : 0;
    d.told += tells_a.x != tells_b.x || tells_a.v != tells_b.v || tells_a.a != tells_b.a || tells_a.f != tells_b.f ? 1 : 0;
  }
  return d;
}

// Who leads alone closes his loop at his own client: whatever the server says of others, and however old it is, not one bit of his force changes, nor
// of what the server is told.
TEST(CopyCoupling, NothingThatTheServerSaysReachesAHandThatLeadsAlone) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Differences d = between_two_servers(1, seed);
    EXPECT_EQ(d.felt, 0) << seed;
    EXPECT_EQ(d.told, 0) << seed;
  }
  EXPECT_GT(between_two_servers(0.9, 1).felt, 1000) << "else the comparison would see nothing";
}

hal::DeviceCaps device(double damping) {
  hal::DeviceCaps caps;
  caps.joints = caps.tip_axes = 3;
  caps.simulated = true;
  caps.axis[0].peak = 3.3;
  caps.damping = damping;
  return caps;
}

TEST(Seat, RendersNoMoreThanItsDeviceDoesWhateverTheServerSays) {
  const SeatSetup stiff = leader();
  EXPECT_NEAR((Seat{stiff, device(0.05), {link::Direction::kToServer, 1, 2}}.setup().coupling.k_c), 93, 1e-9);
  EXPECT_NEAR((Seat{stiff, device(2), {link::Direction::kToServer, 1, 2}}.setup().coupling.k_c), 400, 1e-9);
}

}  // namespace
}  // namespace tandem::client
