// Which hand leads a seat, and where it is: in FORCE and in records.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/control/leading_hand.h"
#include "server/report/trace_csv.h"
#include "server/session/leading_hands.h"
#include "tests/server/session/session_fixture.h"
#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using namespace test;

constexpr std::size_t kTrainer = 0, kTrainee = 1;

double distance(const std::array<float, 3>& a, const std::array<double, 3>& b) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square);
}

TEST(Ghost, ShowsTheLeadersHandToFollowersOnly) {
  SessionFixture rig("free_motion");
  rig.run(4s);
  const wire::Ghost& told = rig.seats[kTrainee].core->force().ghost;
  EXPECT_EQ(told.leader, kTrainer + 1);
  EXPECT_LT(distance(told.x, rig.seats[kTrainer].core->sample().telemetry.x), 0.0005)
      << "without delay: a tick of 0.16 m/s";
  EXPECT_EQ(rig.seats[kTrainer].core->force().ghost, wire::Ghost{});
  const TickRecord& record = rig.session->record();
  EXPECT_EQ(record.seats[kTrainee].leader, kTrainer + 1);
  EXPECT_EQ(record.seats[kTrainer].leader, 0u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(record.seats[kTrainee].ghost[k], told.x[k], 0.0005);
  const TraceCsv csv(rig.scene);
  EXPECT_NE(csv.header().find(",trainee.leader[1],trainee.ghost_x[m],trainee.ghost_y[m],trainee.ghost_z[m],"),
            std::string::npos);
  std::string row;
  csv.append(record, row);
  EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(csv.header(), ','));
  // Offset that the seat's own screen shows.
  const auto beside = offset_from_leader(*rig.seats[kTrainee].core, rig.now);
  ASSERT_TRUE(beside);
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double own = rig.seats[kTrainee].core->sample().telemetry.x[i];
    EXPECT_NEAR((*beside)[k], own - rig.seats[kTrainer].core->sample().telemetry.x[i], 0.0005);
    square += (*beside)[k] * (*beside)[k];
  }
  EXPECT_GT(square, 0);
  EXPECT_FALSE(offset_from_leader(*rig.seats[kTrainer].core, rig.now));
}

TEST(Ghost, ChangesWithAuthority) {
  SessionFixture rig("free_motion");  // from 11.5 s on the trainee has all authority
  rig.run(13s);
  EXPECT_EQ(rig.seats[kTrainer].core->force().ghost.leader, kTrainee + 1);
  EXPECT_EQ(rig.seats[kTrainee].core->force().ghost.leader, 0u);
}

TEST(Ghost, IsRecordedUnderEveryLawAndSentUnderReplicaOnly) {
  SessionFixture rig("free_motion", 3, {}, 0, [](SceneSpec& scene) { choose_law(scene, LawKind::kSetPosition); });
  rig.run(4s);
  EXPECT_EQ(rig.session->record().seats[kTrainee].leader, kTrainer + 1);
  EXPECT_EQ(rig.seats[kTrainee].core->force().ghost.leader, 0u);
}

TEST(LeadingHand, StaysWithinTheLimitsOfForceMessages) {
  control::LeadingHand hand;
  PortSample heard;
  heard.x[0] = 9.99;
  heard.v[0] = 100;
  for (int i = 0; i < 1000; ++i) hand.step(true, heard, 3, 10);
  EXPECT_LE(static_cast<float>(hand.shown_x(0, 9.99)), wire::kPositionMaxM);
  EXPECT_LE(std::abs(static_cast<float>(hand.shown_v(0))), wire::kVelocityMax);
}

/// Authority of three masters over one tool, without clients.
TEST(LeadingHands, NamesThePresentHandWithTheMostAuthority) {
  for (const LawKind law : {LawKind::kReplica, LawKind::kSetPosition}) {
    SessionParts parts("eight_seats");
    parts.scene.channel.law = law;
    LeadingHands hands(parts.scene, parts.clock.dt());
    const auto leaders = [&](std::initializer_list<double> alpha, std::initializer_list<std::size_t> present) {
      parts.present = {};
      for (const std::size_t i : present) parts.present[i] = true;
      control::MasterArray wanted{};
      std::ranges::copy(alpha, wanted.begin());
      EXPECT_TRUE(parts.tools[0].authority.request(wanted));
      for (int n = 0; n < 10'000; ++n) parts.step_authority();
      hands.step(0, parts.present, parts.seats, parts.tools);
      return std::array{hands.ghost(0).leader, hands.ghost(1).leader, hands.ghost(2).leader};
    };
    using Leaders = std::array<std::uint32_t, 3>;
    EXPECT_EQ(leaders({1, 0, 0}, {0, 1, 2}), (Leaders{0, 1, 1})) << "seat 0 leads; numbers count from 1";
    EXPECT_EQ(leaders({0.2, 0.5, 0.3}, {0, 1, 2}), (Leaders{2, 0, 2}));
    EXPECT_EQ(leaders({0, 0.5, 0.5}, {0, 1, 2}), (Leaders{2, 0, 0})) << "among equals the first; none leads an equal";
    EXPECT_EQ(leaders({1, 0, 0}, {1, 2}), (Leaders{0, 0, 0})) << "an absent hand leads no seat";
  }
}

TEST(LeadingHands, AreUpdatedEverySixteenthTickIfTheyAreOnlyRecorded) {
  SessionParts parts("eight_seats");
  parts.scene.channel.law = LawKind::kSetPosition;
  LeadingHands hands(parts.scene, parts.clock.dt());
  parts.present[0] = true;
  ASSERT_TRUE(parts.tools[0].authority.request({1}));
  for (int n = 0; n < 10'000; ++n) parts.step_authority();
  for (std::uint32_t tick = 1; tick < 16; ++tick) {
    hands.step(tick, parts.present, parts.seats, parts.tools);
    ASSERT_EQ(hands.ghost(1).leader, 0u) << tick;
  }
  hands.step(16, parts.present, parts.seats, parts.tools);
  EXPECT_EQ(hands.ghost(1).leader, 1u);
}

}  // namespace
}  // namespace tandem::server
