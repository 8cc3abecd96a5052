// A client with a seat and its keys that misbehaves (tests/FAILURES.md): its effects, and the audit events.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

#include "netsim/system/simulated_handshake.h"
#include "server/session/session.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

PeerAddress address(std::uint8_t n) {
  PeerAddress e;
  e.bytes[0] = std::byte{n};
  e.size = 1;
  return e;
}

/// A session, with a client at one seat that sends arbitrary messages.
struct Rig {
  explicit Rig(std::size_t which, Role role = Role::kTrainee, SceneSpec of = test::shipped("free_motion"))
      : scene(std::move(of)), number(which) {
    scene.seats[number].role = role;
    scene.authority[0].alpha = {0.4, 0.6};
    AxisArray scale;
    scale.fill(1);
    std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
    slaves.push_back(std::move(*hal::sim::SimDevice::make({scene.tools[0].slave, {}, {}, nullptr, Time{}})));
    session = std::make_unique<Session>(scene, std::move(slaves), scale);
    hal::DeviceCaps caps;
    caps.joints = caps.tip_axes = 3;
    caps.simulated = true;
    const auto joined = netsim::simulate_join(*session, now, number, caps, RandomKey{5}, 1);
    link = std::make_unique<transport::SecureChannel>(joined->channel_params);
    state.ready = state.engaged = true;
  }
  template <class Message>
  void send(wire::Type type, const Message& message, std::optional<wire::Preamble> preamble = {}) {
    const std::size_t plain = codec.encode(preamble.value_or(link->preamble(now, 0)), message,
                                           std::span{buffer}.subspan(transport::kHeaderSize));
    const std::size_t size = link->seal(now, type, buffer, plain);
    session->on_datagram(now, address(1), std::span{buffer}.first(size));
  }
  /// Runs one tick of the server, 1 ms.
  void tick() {
    session->on_tick(now, 0);
    while (const auto out = session->poll_transmit(now, buffer)) {
      const auto opened = link->open(now, std::span{buffer}.first(out->size));
      if (!opened) continue;
      if (opened->type == wire::Type::kPathChallenge) {
        link->accept_other();
        send(wire::Type::kPathResponse, codec.decode_path(opened->plaintext)->message);
      } else if (const auto heard = codec.decode_force(opened->plaintext); heard && hears) {
        link->accept(now, *opened, heard->preamble);
        force = heard->message;
        ++forces;
      }
    }
    while (const auto e = session->audit().poll()) ++audit[e->what];
    now += 1ms;
  }
  void live(Duration length) {
    for (const Time end = now + length; now < end;) {
      send(wire::Type::kState, state);
      tick();
    }
  }
  [[nodiscard]] const SeatEndpoint& port() const { return session->seat(number); }
  [[nodiscard]] std::uint64_t refused(transport::DropReason why) const {
    return port().link()->stats().dropped[static_cast<std::size_t>(why)];
  }

  SceneSpec scene;
  std::size_t number;
  Time now{1ms};
  std::unique_ptr<Session> session;
  std::unique_ptr<transport::SecureChannel> link;
  wire::Codec codec{body_layout(seat_setup(scene, number))};
  wire::StateMessage state;
  wire::ForceMessage force;
  bool hears = true;
  std::uint64_t forces = 0;
  std::map<AuditEvent::What, int> audit;
  std::array<std::byte, transport::kDatagramMax> buffer{};
};

TEST(Hostile, ActsAtTheAllowedRateWhenItSendsAtTenKilohertz) {
  Rig rig{1};
  rig.live(100ms);
  const std::uint64_t before = rig.port().generation();
  for (int ms = 0; ms < 4000; ++ms) {
    for (int k = 0; k < 10; ++k) rig.send(wire::Type::kState, rig.state);
    rig.tick();
  }
  EXPECT_LE(rig.port().generation() - before, 4u * 1250 + RateLimit::kBurst + 2);
  EXPECT_GE(rig.port().generation() - before, 4u * 1250);
  EXPECT_NEAR(static_cast<double>(rig.refused(transport::DropReason::kRate)), 40'000 - 4 * 1250 - RateLimit::kBurst, 3);
  EXPECT_EQ(rig.audit[AuditEvent::What::kFlood], 1);
  EXPECT_FALSE(rig.port().misbehaviour().quarantined(rig.now))
      << "too often is not malformed; its rate is what is left of it";
}

TEST(Hostile, CausesNoFloodEventAtTheNominalRate) {
  Rig rig{1};
  rig.live(4s);
  EXPECT_EQ(rig.refused(transport::DropReason::kRate), 0u);
  EXPECT_EQ(rig.audit[AuditEvent::What::kFlood], 0);
}

TEST(Hostile, IsQuarantinedWithinATickOfAnInvalidMessage) {
  const auto after = [](auto&& change) {
    Rig rig{1};
    rig.live(300ms);
    EXPECT_TRUE(rig.port().present(rig.now));
    wire::StateMessage bad = rig.state;
    change(bad);
    rig.send(wire::Type::kState, bad);
    rig.tick();
    EXPECT_FALSE(rig.port().present(rig.now));
    EXPECT_FALSE(rig.force.engage);
    EXPECT_EQ(rig.audit[AuditEvent::What::kQuarantined], 1);
    for (const double x : rig.session->tool(0).position()) EXPECT_LT(std::abs(x), 1);
    rig.live(900ms);
    EXPECT_FALSE(rig.port().present(rig.now)) << "until it has behaved for a second";
    rig.live(200ms);
    EXPECT_TRUE(rig.port().present(rig.now));
    EXPECT_EQ(rig.audit[AuditEvent::What::kCleared], 1);
  };
  after([](auto& m) { m.port.x[0] = 1e308; });
  after([](auto& m) { m.port.x[1] = 100; });
  after([](auto& m) { m.port.x[2] = 2; });  // in range, but no hand gets there within a millisecond
  after([](auto& m) { m.port.f[0] = std::numeric_limits<double>::quiet_NaN(); });
  after([](auto& m) { m.port.v[0] = -1e9; });
  after([](auto& m) { m.port.e_in[0] = ~std::uint64_t{0}; });
}

TEST(Hostile, ChangesNothingWithAnotherRolesMessagesAndIsAuditedOncePerSecond) {
  for (const Role role : {Role::kTrainee, Role::kEvaluator, Role::kObserver}) {
    Rig rig{1, role};
    if (role != Role::kTrainee) rig.scene.authority[0].alpha = {1, 0};
    rig.live(300ms);
    const std::uint32_t version = rig.session->authority().version();
    wire::AuthorityMessage grab{.version = version, .tool = 0, .masters = 2, .alpha = {0.1, 0.9}};
    for (int n = 0; n < 500; ++n) {
      rig.send(wire::Type::kAuthority, grab);
      rig.live(4ms);
    }
    EXPECT_EQ(rig.session->authority().version(), version);
    EXPECT_GE(rig.audit[AuditEvent::What::kForbidden], 2);
    EXPECT_LE(rig.audit[AuditEvent::What::kForbidden], 3);
    EXPECT_EQ(rig.refused(transport::DropReason::kRole), role == Role::kTrainee ? 0u : 500u)
        << "before its payload was parsed";
  }
}

TEST(Hostile, TakesNoAuthorityAsATraineeAndMayReturnItsOwn) {
  Rig rig{1};
  rig.state.engaged = false;  // the tool is braked now, so the absent instructor blocks no transfer
  rig.live(300ms);
  const auto ask = [&](double a, double b, std::uint32_t older = 0) {
    const std::uint32_t version = rig.session->authority().version();
    rig.send(wire::Type::kAuthority,
             wire::AuthorityMessage{.version = version - older, .tool = 0, .masters = 2, .alpha = {a, b}});
    rig.live(2ms);
    return rig.session->authority().version() != version;
  };
  EXPECT_FALSE(ask(0.3, 0.7)) << "takes";
  EXPECT_FALSE(ask(0.9, 0.1, 1)) << "of an older version";
  EXPECT_TRUE(ask(0.7, 0.3));
  EXPECT_EQ(rig.session->tool(0).transfer.scheduled()[0], 0.7);
  EXPECT_TRUE(ask(1, 0));
  EXPECT_FALSE(ask(0, 1));
  EXPECT_EQ(rig.audit[AuditEvent::What::kAuthority], 2);
}

TEST(OneWayLink, LosesAClientThatSendsButReceivesNothing) {
  for (const SceneSpec& scene : test::under_both_laws("free_motion")) {
    Rig rig{1, Role::kTrainee, scene};
    rig.live(300ms);
    rig.hears = false;
    const int limit = static_cast<int>(std::lround(1e3 * silence_limits(scene.gate, scene.channel.law, 1).most));
    int lost_after = -1;
    for (int ms = 0; ms < 700 && lost_after < 0; ++ms) {
      rig.live(1ms);
      if (!rig.port().present(rig.now)) lost_after = ms + 1;
    }
    EXPECT_LE(lost_after, limit + 25);
    EXPECT_GT(lost_after, limit) << "shorter gaps are the client's own gate's to judge";
    EXPECT_EQ(rig.audit[AuditEvent::What::kLoss], 1);
    rig.hears = true;
    rig.live(10ms);
    EXPECT_TRUE(rig.port().present(rig.now));
    EXPECT_EQ(rig.audit[AuditEvent::What::kBack], 1);
  }
}

TEST(OneWayLink, LosesAClientWhoseEchoDoesNotAdvance) {
  for (const SceneSpec& scene : test::under_both_laws("free_motion")) {
    Rig rig{1, Role::kTrainee, scene};
    rig.live(300ms);
    const wire::Preamble still{rig.link->preamble(rig.now, 0).echo_counter, 0, 0};
    const int most =
        std::max(200, static_cast<int>(std::lround(1e3 * silence_limits(scene.gate, scene.channel.law, 1).most)) + 20);
    int lost_after = -1;
    for (int ms = 0; ms < 700 && lost_after < 0; ++ms) {
      rig.send(wire::Type::kState, rig.state, still);
      rig.tick();
      if (!rig.port().present(rig.now)) lost_after = ms + 1;
    }
    EXPECT_GT(lost_after, most - 10);
    EXPECT_LE(lost_after, most + 5);
  }
}

TEST(Observer, ReceivesAtMost60ForcesPerSecondAndIsNeverEngaged) {
  Rig rig{1, Role::kObserver};
  rig.scene.seats[0].required = false;
  rig.live(300ms);
  const std::uint64_t before = rig.forces;
  for (int n = 0; n < 2000; ++n) {
    rig.live(1ms);
    ASSERT_FALSE(rig.force.engage);
  }
  EXPECT_LE(rig.forces - before, 120u);
  EXPECT_GE(rig.forces - before, 100u);
}

TEST(StopLatch, TakesARisingEdgeOncePerSeatAndAResumeOfTheNewestStopOnly) {
  Rig rig{0, Role::kInstructor};
  rig.live(200ms);
  rig.state.stop_all = true;
  rig.live(50ms);
  EXPECT_EQ(rig.session->stop_control().latch().stops(), 1u) << "a level that lasts is one stop";
  EXPECT_EQ(rig.force.session, wire::SessionState::kStopped);
  EXPECT_EQ(rig.force.stops, 1u);
  rig.state.stop_all = false;
  rig.live(5ms);
  EXPECT_TRUE(rig.session->stop_control().request(rig.now, {AccessRole::kOperator}));
  EXPECT_EQ(rig.session->stop_control().latch().stops(), 2u);
  rig.state.resume_stop = 1;
  rig.live(50ms);
  EXPECT_EQ(rig.force.session, wire::SessionState::kStopped) << "an old request never ends a newer stop";
  EXPECT_EQ(rig.session->stop_control().resume(rig.now, {AccessRole::kOperator}, 1), CommandResult::kOutdated)
      << "the role may, but the named stop is not the newest";
  rig.live(5ms);
  EXPECT_EQ(rig.force.session, wire::SessionState::kStopped) << "nor does a request of a console";
  rig.state.resume_stop = 2;
  rig.live(5ms);
  EXPECT_NE(rig.force.session, wire::SessionState::kStopped);
  EXPECT_FALSE(rig.session->stop_control().request(rig.now, {AccessRole::kObserver}));
  EXPECT_FALSE(rig.session->stop_control().request(rig.now, {AccessRole::kRecorder}));
  EXPECT_EQ(rig.audit[AuditEvent::What::kStop], 2);
  EXPECT_EQ(rig.audit[AuditEvent::What::kResume], 1);
}

TEST(StopLatch, LetsAPausingRoleNeitherEndAPauseNorWeakenAStop) {
  Rig rig{1};
  rig.live(200ms);
  rig.state.stop_all = true;
  rig.live(5ms);
  EXPECT_EQ(rig.force.session, wire::SessionState::kPaused);
  rig.state.stop_all = false;
  rig.state.resume_stop = 1;
  rig.live(20ms);
  EXPECT_EQ(rig.force.session, wire::SessionState::kPaused);
  EXPECT_EQ(rig.audit[AuditEvent::What::kForbidden], 1);
  rig.state.resume_stop = 0;
  EXPECT_TRUE(rig.session->stop_control().request(rig.now, {AccessRole::kInstructor}));
  rig.state.stop_all = true;
  rig.live(5ms);
  EXPECT_EQ(rig.force.session, wire::SessionState::kStopped);
  EXPECT_EQ(
      rig.session->stop_control().resume(rig.now, {AccessRole::kOperator}, rig.session->stop_control().latch().stops()),
      CommandResult::kDone);
  rig.live(5ms);
  EXPECT_EQ(rig.force.session, wire::SessionState::kPaused)
      << "the trainee still requests it: again, which is only a pause";
}

TEST(Audit, AFullQueueDropsTheNewestAndCounts) {
  AuditQueue queue;
  for (std::uint32_t n = 0; n < AuditQueue::kCapacity + 5; ++n) {
    AuditEvent e;
    e.version = n;
    queue.push(e);
  }
  EXPECT_EQ(queue.dropped(), 5u);
  for (std::uint32_t n = 0; n < AuditQueue::kCapacity; ++n) EXPECT_EQ(queue.poll()->version, n);
  EXPECT_FALSE(queue.poll());
}

}  // namespace
}  // namespace tandem::server
