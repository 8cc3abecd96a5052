#include "proto/text/seat_setup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem {
namespace {

using Buffer = std::array<char, wire::kSetupMax>;

/// Expects equality except for rounding in the conversion between s and ms.
void expect_near(double a, double b) { EXPECT_LE(std::abs(a - b), 1e-15 + 1e-14 * std::abs(a)) << a << " " << b; }

void expect_same(const SeatSetup& a, const SeatSetup& b) {
  EXPECT_EQ(a.tick_hz, b.tick_hz);
  EXPECT_EQ(a.dof, b.dof);
  EXPECT_EQ(a.port, b.port);
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_EQ(a.clock_runs_while_stopped, b.clock_runs_while_stopped);
  EXPECT_EQ(a.masters, b.masters);
  EXPECT_EQ(a.tools, b.tools);
  EXPECT_EQ(a.own_master, b.own_master);
  EXPECT_EQ(a.driver_mask, b.driver_mask);
  EXPECT_EQ(a.alpha_slew, b.alpha_slew);
  EXPECT_EQ(a.channel.law, b.channel.law);
  EXPECT_EQ(a.channel.mfs, b.channel.mfs);
  EXPECT_EQ(a.channel.k, b.channel.k);
  EXPECT_EQ(a.channel.k_min, b.channel.k_min);
  EXPECT_EQ(a.channel.e0, b.channel.e0);
  expect_near(a.channel.lead_max, b.channel.lead_max);
  EXPECT_EQ(a.coupling.k_c, b.coupling.k_c);
  EXPECT_EQ(a.k_s, b.k_s);
  expect_near(a.gate.silence_limit, b.gate.silence_limit);
  expect_near(a.gate.loop_age_max, b.gate.loop_age_max);
  EXPECT_EQ(a.gate.latch, b.gate.latch);
  EXPECT_EQ(a.gate.force_max, b.gate.force_max);
  EXPECT_EQ(a.seat.name, b.seat.name);
  EXPECT_EQ(a.seat.kind, b.seat.kind);
  EXPECT_EQ(a.seat.role, b.seat.role);
  EXPECT_EQ(a.seat.tool, b.seat.tool);
  EXPECT_EQ(a.seat.device.model, b.seat.device.model);
  EXPECT_EQ(a.seat.device.encoder, b.seat.device.encoder);
  EXPECT_EQ(a.seat.device.start.x, b.seat.device.start.x);
  EXPECT_EQ(a.seat.hand.model, b.seat.hand.model);
  EXPECT_EQ(a.seat.assist.force, b.seat.assist.force);
  EXPECT_EQ(a.seat.assist.in_contact, b.seat.assist.in_contact);
  EXPECT_EQ(a.seat.motion_scale, b.seat.motion_scale);
  EXPECT_EQ(a.seat.force_separation, b.seat.force_separation);
  EXPECT_EQ(a.seat.device.load, b.seat.device.load);
  EXPECT_EQ(a.seat.device.calibrate, b.seat.device.calibrate);
  EXPECT_EQ(a.seat.hand.from, b.seat.hand.from);
  EXPECT_EQ(a.seat.hand.until, b.seat.hand.until);
  EXPECT_EQ(a.seat.hand.relaxed_b, b.seat.hand.relaxed_b);
  EXPECT_EQ(a.seat.hand.deviations.size(), b.seat.hand.deviations.size());
  ASSERT_EQ(a.seat.hand.trajectory.waypoints.size(), b.seat.hand.trajectory.waypoints.size());
  for (std::size_t i = 0; i < a.seat.hand.trajectory.waypoints.size(); ++i) {
    EXPECT_EQ(a.seat.hand.trajectory.waypoints[i].at, b.seat.hand.trajectory.waypoints[i].at);
    EXPECT_EQ(a.seat.hand.trajectory.waypoints[i].p.x, b.seat.hand.trajectory.waypoints[i].p.x);
  }
  EXPECT_EQ(a.seat.environment.wall.has_value(), b.seat.environment.wall.has_value());
  EXPECT_EQ(a.channel.b_rel, b.channel.b_rel);
  expect_near(a.gate.local_hold, b.gate.local_hold);
  expect_near(a.gate.follow_hold, b.gate.follow_hold);
  EXPECT_EQ(a.m_s, b.m_s);
  EXPECT_EQ(a.b_s, b.b_s);
  EXPECT_EQ(a.stiffness_asked, b.stiffness_asked);
  ASSERT_EQ(a.environment.wall.has_value(), b.environment.wall.has_value());
  if (a.environment.wall) {
    EXPECT_EQ(a.environment.wall->axis, b.environment.wall->axis);
    EXPECT_EQ(a.environment.wall->at, b.environment.wall->at);
    EXPECT_EQ(a.environment.wall->k, b.environment.wall->k);
    EXPECT_EQ(a.environment.wall->b, b.environment.wall->b);
    EXPECT_EQ(a.environment.wall->from_below, b.environment.wall->from_below);
    EXPECT_EQ(a.environment.wall->mu, b.environment.wall->mu);
  }
  EXPECT_EQ(a.environment.tissue.has_value(), b.environment.tissue.has_value());
  for (std::size_t i = 0; i < a.dof; ++i) EXPECT_EQ(a.axis_scale[i], b.axis_scale[i]);
}

SceneSpec scene(std::string_view name) { return parse_scene(find_shipped_scene(name)->text, name).value(); }

TEST(SeatSetup, RoundTripsForEveryShippedSeat) {
  for (const auto& shipped : shipped_scenes()) {
    const auto spec = scene(shipped.name);
    for (std::size_t s = 0; s < spec.seats.size(); ++s) {
      SCOPED_TRACE(std::string(shipped.name) + " " + spec.seats[s].name);
      auto setup = seat_setup(spec, s);
      for (std::size_t axis = 0; axis < spec.dof; ++axis)
        setup.axis_scale[axis] = 0.0123 * static_cast<double>(axis + 1);
      Buffer buffer;
      const auto size = encode_seat_setup(setup, buffer);
      ASSERT_GT(size, 0u);
      EXPECT_LE(size, wire::kSetupMax);
      const auto got = decode_seat_setup(std::span(buffer).first(size));
      ASSERT_TRUE(got.has_value()) << to_text(got.error());
      expect_same(setup, *got);
    }
  }
}

TEST(SeatSetup, CarriesSurfaceFrictionButNoRemoteEnvironment) {
  auto setup = seat_setup(scene("contact"), 0);
  setup.environment.wall.emplace().mu = 0.4;
  setup.environment.tissue.emplace().mu = 0.7;
  Buffer buffer;
  const auto got = decode_seat_setup(std::span(buffer).first(encode_seat_setup(setup, buffer)));
  ASSERT_TRUE(got.has_value()) << to_text(got.error());
  EXPECT_EQ(got->environment.wall->mu, 0.4);
  EXPECT_EQ(got->environment.tissue->mu, 0.7);
  const SceneSpec remote = scene("contact_remote");
  EXPECT_TRUE(remote.tools[0].environment.wall.has_value());
  EXPECT_FALSE(seat_setup(remote, 0).environment.wall.has_value());
}

TEST(SeatSetup, CarriesEachToolThatASeatFollows) {
  SceneSpec two = scene("two_by_two");
  two.follow[0] = {0.25, 0.75};
  two.tools[1].m_s = 0.07;
  two.tools[1].environment.wall.emplace().at = 0.011;
  const auto setup = seat_setup(two, 0);
  Buffer buffer;
  const auto got = decode_seat_setup(std::span(buffer).first(encode_seat_setup(setup, buffer)));
  ASSERT_TRUE(got.has_value()) << to_text(got.error());
  EXPECT_EQ(got->weight, 0.25);
  ASSERT_EQ(got->further.size(), 1u);
  EXPECT_EQ(got->further[0].tool, 1u);
  EXPECT_EQ(got->further[0].weight, 0.75);
  EXPECT_EQ(got->further[0].m_s, 0.07);
  EXPECT_EQ(got->further[0].environment.wall->at, 0.011);
  EXPECT_TRUE(seat_setup(two, 1).further.empty()) << "the seat follows one tool";

  const auto refused = [&](auto&& change) {
    auto wrong = setup;
    change(wrong);
    return !decode_seat_setup(std::span(buffer).first(encode_seat_setup(wrong, buffer))).has_value();
  };
  EXPECT_TRUE(refused([](auto& s) { s.further[0].weight = 0.7; })) << "the weights do not sum to 1";
  EXPECT_TRUE(refused([](auto& s) { s.further[0].tool = 0; })) << "the same tool twice";
  EXPECT_TRUE(refused([](auto& s) { s.channel.law = LawKind::kSetPosition; }));
}

TEST(SeatSetup, RoundTripsALongMotionAndManyNames) {
  auto setup = seat_setup(scene("contact_remote"), 0);
  setup.seat.hand.trajectory = {};
  setup.seat.hand.trajectory.kind = Trajectory::Kind::kWaypoints;
  for (int i = 0; i < 64; ++i) setup.seat.hand.trajectory.waypoints.push_back({0.1 + i, {0.011, -0.012, 0.001 * i}});
  for (int i = 0; i < 8; ++i) setup.seat.hand.deviations.push_back({0.3 + i, 0.1, {1.1, 2.2, -3.3}});
  setup.masters.assign(16, std::string(wire::kSeatNameMax, 'm'));
  setup.tools.assign(8, std::string(wire::kSeatNameMax, 't'));
  Buffer buffer;
  const auto size = encode_seat_setup(setup, buffer);
  ASSERT_GT(size, 3000u);
  const auto got = decode_seat_setup(std::span(buffer).first(size));
  ASSERT_TRUE(got.has_value()) << to_text(got.error());
  expect_same(setup, *got);
  EXPECT_EQ(setup.tools, got->tools);
}

TEST(SeatSetup, NamesTheMastersAndMultipleToolsToEverySeat) {
  const auto spec = scene("two_by_two");
  for (std::size_t s = 0; s < spec.seats.size(); ++s) {
    EXPECT_EQ(seat_setup(spec, s).masters.size(), spec.masters());
    EXPECT_EQ(seat_setup(spec, s).tools.size(), 2u);
  }
  const auto lesson = scene("lesson");
  EXPECT_EQ(seat_setup(lesson, 1).masters[0], "instructor");
  EXPECT_TRUE(seat_setup(lesson, 1).tools.empty());
  EXPECT_TRUE(seat_setup(lesson, 0).moves_authority());
  EXPECT_FALSE(seat_setup(lesson, 1).moves_authority()) << "a trainee knows the names and gives nothing";
}

TEST(SeatSetup, CarriesSpringAndEnvironmentForASlaveSeat) {
  const auto spec = scene("contact_remote");
  const auto setup = seat_setup(spec, 2);
  EXPECT_EQ(setup.seat.kind, SeatKind::kSlave);
  EXPECT_EQ(setup.k_s, 400);
  ASSERT_TRUE(setup.seat.environment.wall.has_value());
  EXPECT_EQ(setup.seat.environment.wall->k, 20000);
}

/// A master of law REPLICA simulates the tool, so its setup contains the tool's mass, damping and environment.
TEST(SeatSetup, CarriesTheToolModelForAMaster) {
  auto spec = scene("contact");
  ASSERT_EQ(spec.channel.law, LawKind::kReplica);
  spec.tools[0].m_s = 0.033;
  spec.tools[0].b_s = 0.44;
  spec.tools[0].environment.tissue = TissueSpec{};
  const auto setup = seat_setup(spec, 1);
  EXPECT_EQ(setup.m_s, 0.033);
  EXPECT_EQ(setup.b_s, 0.44);
  ASSERT_TRUE(setup.environment.wall && setup.environment.tissue);
  Buffer buffer;
  const auto size = encode_seat_setup(setup, buffer);
  const auto got = decode_seat_setup(std::span(buffer).first(size));
  ASSERT_TRUE(got.has_value()) << to_text(got.error());
  expect_same(setup, *got);
  EXPECT_EQ(got->channel.law, LawKind::kReplica);
}

TEST(SeatSetup, IsCheckedAgainstTheLimitsOfFiles) {
  const auto spec = scene("contact");
  const auto refused = [&](auto change, const std::string& key) {
    auto setup = seat_setup(spec, 0);
    change(setup);
    Buffer buffer;
    const auto size = encode_seat_setup(setup, buffer);
    ASSERT_GT(size, 0u);
    const auto got = decode_seat_setup(std::span(buffer).first(size));
    ASSERT_FALSE(got.has_value()) << key;
    EXPECT_EQ(got.error()[0].key, key) << to_text(got.error());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([&](SeatSetup& s) { s.tick_hz = nan; }, "tick_hz");
  refused([&](SeatSetup& s) { s.tick_hz = 0; }, "tick_hz");
  refused([&](SeatSetup& s) { s.alpha_slew = 1e9; }, "alpha_slew_per_s");
  refused([&](SeatSetup& s) { s.dof = 4; }, "dof");
  refused([&](SeatSetup& s) { s.gate.silence_limit = 0.5; }, "gate.silence_limit_ms");
  refused([&](SeatSetup& s) { s.gate.force_max = 1e9; }, "gate.force_max_n");
  refused([&](SeatSetup& s) { s.gate.local_hold = 0.51; }, "gate.local_hold_ms");
  refused([&](SeatSetup& s) { s.channel.b_rel = -1; }, "channel.b_rel_n_s_m");
  refused([&](SeatSetup& s) { s.seat.assist.force = 3.1; }, "seat.assist.force_n");
  refused([&](SeatSetup& s) { s.seat.motion_scale = 0.05; }, "seat.motion_scale");
  refused([&](SeatSetup& s) { s.seat.motion_scale = nan; }, "seat.motion_scale");
  refused([&](SeatSetup& s) { s.seat.device.load = -1; }, "seat.device.load_kg");
  refused([&](SeatSetup& s) { s.seat.force_separation = true; }, "seat.force_separation");
  refused([&](SeatSetup& s) { s.seat.assist.force = nan; }, "seat.assist.force_n");
  refused([&](SeatSetup& s) { s.m_s = 0; }, "m_s_kg");
  refused([&](SeatSetup& s) { s.b_s = nan; }, "b_s_n_s_m");
  refused([&](SeatSetup& s) { s.environment.wall->k = -1; }, "environment.wall.k_n_m");
  refused([&](SeatSetup& s) { s.coupling.k_c = -1; }, "device_coupling.k_c_n_m");
  refused([&](SeatSetup& s) { s.axis_scale[1] = 0; }, "axis_scale[1]");
  refused([&](SeatSetup& s) { s.seat.name = "\x1b[2J"; }, "seat.name");
  refused([&](SeatSetup& s) { s.seat.hand.model = static_cast<HandModel>(99); }, "seat.hand.model");
  refused([&](SeatSetup& s) { s.seat.hand.trajectory.waypoints[1].at = 0; }, "seat.hand.trajectory.waypoint[1].at_s");
  refused([&](SeatSetup& s) { s.channel.e0 = 11; }, "channel.e0_j");
  refused(
      [&](SeatSetup& s) {
        s.channel.law = LawKind::kSetPosition;
        s.channel.e0 = 1e-3;
      },
      "channel.e0_j");
  refused([&](SeatSetup& s) { s.port = PortSpace::kJoint; }, "channel.law");
  refused([&](SeatSetup& s) { s.seat.device.model = DeviceModel::kLinear; }, "seat.device.model");
}

TEST(SeatSetup, SurvivesEveryPrefixAndEveryFlippedByte) {
  Buffer buffer;
  const auto size = encode_seat_setup(seat_setup(scene("contact_remote"), 0), buffer);
  for (std::size_t cut = 0; cut < size; ++cut) {
    const std::vector<char> prefix(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(cut));
    EXPECT_FALSE(decode_seat_setup(prefix).has_value()) << cut;
  }
  for (std::size_t at = 0; at < size; ++at) {
    for (const int value : {0x00, 0x01, 0x08, 0x7f, 0x80, 0xf0, 0xff}) {
      std::vector<char> changed(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
      changed[at] = static_cast<char>(value);
      if (const auto got = decode_seat_setup(changed)) {
        EXPECT_TRUE(got->tick_hz >= 100 && got->tick_hz <= 10000);
        EXPECT_TRUE(got->gate.force_max > 0 && got->gate.force_max <= 50);
        EXPECT_TRUE(got->coupling.k_c > 0 && got->coupling.k_c <= 1e5);
        EXPECT_TRUE(got->dof >= 1 && got->dof <= 3);
      }
    }
  }
}

TEST(SeatSetup, RejectsNoise) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    RandomStream random(seed);
    std::vector<char> noise(static_cast<std::size_t>(random.below(1200)));
    for (auto& c : noise) c = static_cast<char>(random.bits());
    EXPECT_FALSE(decode_seat_setup(noise).has_value()) << seed;
  }
}

}  // namespace
}  // namespace tandem
