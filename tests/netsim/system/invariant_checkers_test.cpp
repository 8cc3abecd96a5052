// Each checker accepts a correct system. It reports a rule that is broken, or that a stricter scene would break.
#include <gtest/gtest.h>

#include <map>

#include "netsim/system/authority_checker.h"
#include "netsim/system/channel_end_checker.h"
#include "netsim/system/delivery_checker.h"
#include "netsim/system/device_guard_checker.h"
#include "netsim/system/effort_checker.h"
#include "netsim/system/hand_energy_checker.h"
#include "netsim/system/restart_barrier_checker.h"
#include "netsim/system/role_checker.h"
#include "netsim/system/silence_checker.h"
#include "tests/netsim/system/observed_run.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;
using What = server::AuditEvent::What;

SceneSpec two_hands() { return test::set_position("free_motion"); }

TEST(TipNorm, ScalesEachAxis) {
  EXPECT_DOUBLE_EQ(tip_norm({6, 4, 9}, {4, 1, 1}, 2), 5) << "sqrt(36 / 4 + 16), without the third axis";
}

TEST(EffortChecker, AcceptsAClientAndReportsALowerLimit) {
  for (const double limit : {3.3, 1e-3}) {
    ObservedRun run{two_hands()};
    run.judged.gate.force_max = limit;
    std::map<std::size_t, EffortChecker> checkers;
    run.run_clients(4, [&](const ObservedSeat& seat) { checkers[seat.index].check(seat); });
    EXPECT_EQ(run.count("effort_limited") > 0, limit < 1);
    EXPECT_EQ(run.count("effort_finite") + run.count("effort_slew"), 0u);
  }
}

TEST(EffortChecker, ReportsAForceThatAppearsInOneTick) {
  ObservedRun run{two_hands()};
  run.run(4);
  while (run.observed(0).force() == 0) run.run(0.001);
  EffortChecker unaware;  // of the ramp
  unaware.check(run.observed(0));
  EXPECT_EQ(run.count("effort_slew"), 1u);
  unaware.check(run.observed(0));
  EXPECT_EQ(run.count("effort_slew"), 1u) << "the same effort again is no step";
}

TEST(SilenceChecker, AcceptsAClientInAnOutageAndReportsAShorterLimit) {
  for (const double limit : {0.020, 0.001}) {
    SimulationConfig config{.scene = two_hands()};
    config.network.down.outages = {{.start = 3s, .length = 500ms}};
    ObservedRun run{config};
    run.judged.gate.silence_limit = limit;
    std::map<std::size_t, SilenceChecker> checkers;
    run.run(4, [&](const ObservedSeat& seat) {
      checkers[seat.index].check_energy(seat);
      if (seat.client.seat() != nullptr && seat.client.ran_in_tick()) checkers[seat.index].check(seat);
    });
    EXPECT_EQ(run.count("silence_ramps") > 0, limit < 0.02);
    EXPECT_EQ(run.count("loop_age") + run.count("loss_energy"), 0u);
  }
}

TEST(SilenceChecker, ReportsAnActiveHandWithAnOldLoop) {
  SimulationConfig config{.scene = two_hands()};
  config.network = link_from({.delay = 20ms});
  ObservedRun run{config};
  run.judged.gate.loop_age_max = 0.03;
  std::map<std::size_t, SilenceChecker> checkers;
  run.run_clients(3, [&](const ObservedSeat& seat) { checkers[seat.index].check(seat); });
  EXPECT_GT(run.count("loop_age"), 0u);
}

TEST(DeviceGuardChecker, AcceptsAClientWhoseDeviceFails) {
  for (const Fault::Kind kind : {Fault::Kind::kNotANumber, Fault::Kind::kFrozen, Fault::Kind::kHot}) {
    SimulationConfig config{.scene = two_hands()};
    config.faults = {{.kind = kind, .seat = config.scene.seats[0].name, .at = 3s, .length = 500ms}};
    ObservedRun run{config};
    std::map<std::size_t, DeviceGuardChecker> checkers;
    run.run_clients(4, [&](const ObservedSeat& seat) { checkers[seat.index].check(seat); });
    EXPECT_TRUE(run.violations.list().empty()) << name(kind);
  }
}

TEST(DeviceGuardChecker, ReportsAGuardThatDoesNotActInTime) {
  for (const auto& [kind, invariant, most] :
       {std::tuple{Fault::Kind::kNotANumber, "bad_reading_faults", 3}, {Fault::Kind::kHot, "over_temperature", 5}}) {
    SimulationConfig config{.scene = two_hands()};
    config.faults = {{.kind = kind, .seat = config.scene.seats[0].name, .at = 3s, .length = 500ms}};
    ObservedRun run{config};
    run.run(3 - 0.001);
    while (!run.observed(0).client.faults().active(kind, run.observed(0).client.last_run())) run.run(0.001);
    ASSERT_TRUE(run.observed(0).core().gate().active()) << "the first tick of the fault";
    DeviceGuardChecker checker;  // sees this tick several times, as if the client did nothing
    for (int n = 0; n < most; ++n) checker.check(run.observed(0));
    EXPECT_EQ(run.count(invariant), 0u);
    checker.check(run.observed(0));
    EXPECT_EQ(run.count(invariant), 1u);
  }
}

TEST(RoleChecker, ReportsAnObserverThatReceivesForce) {
  for (const Role role : {Role::kTrainee, Role::kObserver}) {
    ObservedRun run{two_hands()};
    run.judged.seats[0].role = role;
    run.run(3, [](const ObservedSeat& seat) { check_role(seat); });
    EXPECT_EQ(run.count("observer_force") > 0, role == Role::kObserver);
    EXPECT_EQ(run.count("own_stop") + run.count("stop_engages_nobody"), 0u);
  }
}

TEST(RoleChecker, PermitsEventsByRole) {
  SceneSpec scene = two_hands();
  ASSERT_GE(scene.masters(), 2u);
  server::AuditEvent gives{.what = What::kAuthority, .seat = 0}, takes = gives;
  gives.before[0] = takes.after[0] = 1;
  gives.after[1] = takes.before[1] = 1;
  scene.seats[1].role = Role::kInstructor;
  const struct {
    Role role;
    server::AuditEvent event;
    std::uint64_t violations;
  } kRows[] = {
      {Role::kInstructor, {.what = What::kStop, .seat = 0}, 0},
      {Role::kTrainee, {.what = What::kStop, .seat = 0}, 1},
      {Role::kTrainee, {.what = What::kResume, .seat = 0}, 1},
      {Role::kTrainee, {.what = What::kPause, .seat = 0}, 0},
      {Role::kObserver, {.what = What::kPause, .seat = 0}, 1},
      {Role::kInstructor, takes, 0},
      {Role::kTrainee, gives, 0},
      {Role::kTrainee, takes, 1},
      {Role::kEvaluator, gives, 1},
      {Role::kObserver, {.what = What::kJoin, .seat = 0}, 0},
  };
  for (const auto& row : kRows) {
    server::Violations violations;
    scene.seats[0].role = row.role;
    check_role(row.event, scene, 7, violations);
    std::uint64_t count = 0;
    for (const server::Violation& v : violations.list()) count += v.count;
    EXPECT_EQ(count, row.violations) << &row - kRows;
  }
}

TEST(DeliveryChecker, ReportsDatagramsThatActWithoutArriving) {
  ObservedRun run{two_hands()};
  DeliveryChecker unaware;  // of datagrams at the server
  run.run(2, [&](const ObservedSeat& seat) {
    if (seat.index == 0) unaware.check(seat);
  });
  EXPECT_GT(run.count("acts_once"), 100u);
  EXPECT_EQ(run.count("never_backwards"), 0u);
}

TEST(DeliveryChecker, CountsEachDatagramOnceAndReportsOldTicks) {
  ObservedRun late{two_hands()}, early{two_hands()};
  late.run(2);
  early.run(1);
  DeliveryChecker checker;
  for (std::uint64_t n = 0; n < late.observed(0).endpoint().generation(); ++n) checker.on_server_datagram(n);
  const std::uint64_t accepted = late.observed(0).core().link().stats().accepted;
  checker.check(late.observed(0));
  EXPECT_EQ(late.count("acts_once"), accepted > late.observed(0).client.new_datagrams() ? 1u : 0u)
      << "the client received them in earlier ticks; the server's count is right";
  checker.check(early.observed(0));
  EXPECT_EQ(early.count("never_backwards"), 1u)
      << "FORCE of an earlier tick; at the server another client has the seat";
}

TEST(RestartBarrierChecker, ReportsAnEndOfTheBarrierWhileASeatIsMissing) {
  SimulationConfig config{.scene = two_hands()};
  config.faults = {{.kind = Fault::Kind::kServerRestart, .seat = "", .at = 3s, .length = 100ms}};
  ObservedRun run{config};
  RestartBarrierChecker checker{config.scene};
  const auto check = [&](const ObservedSeat& seat) {
    if (seat.index == 0) checker.check(seat.session, run.violations);
  };
  const std::uint64_t epoch = run.simulation().session().epoch();
  while (run.simulation().session().epoch() == epoch) run.run(0.001, check);
  EXPECT_TRUE(run.violations.list().empty());
  checker.on_audit_event({.what = What::kAllBack, .seat = server::AuditEvent::kNoSeat}, 3, run.violations);
  EXPECT_EQ(run.count("gathering"), 1u);
  checker.on_audit_event({.what = What::kAllBack, .seat = server::AuditEvent::kNoSeat}, 3, run.violations);
  EXPECT_EQ(run.count("gathering"), 1u) << "the barrier is over";
}

TEST(RestartBarrierChecker, AcceptsARestart) {
  SimulationConfig config{.scene = two_hands()};
  config.faults = {{.kind = Fault::Kind::kServerRestart, .seat = "", .at = 3s, .length = 100ms}};
  ObservedRun run{config};
  RestartBarrierChecker checker{config.scene};
  run.simulation().on_audit = [&](const server::AuditEvent& e) { checker.on_audit_event(e, 0, run.violations); };
  run.run(6, [&](const ObservedSeat& seat) {
    if (seat.index == 0) checker.check(seat.session, run.violations);
  });
  EXPECT_TRUE(run.violations.list().empty());
}

TEST(AuthorityChecker, ReportsAnObserverWithAuthority) {
  for (const Role role : {Role::kInstructor, Role::kObserver}) {
    ObservedRun run{two_hands()};
    run.judged.seats[0].role = role;
    AuthorityChecker checker{run.judged};
    run.run(3, [&](const ObservedSeat& seat) {
      if (seat.index == 0) checker.check(1, seat.session, {1, 1, 1, 1, 1, 1, 1}, run.violations);
    });
    EXPECT_EQ(run.count("authority_role") > 0, role == Role::kObserver);
    EXPECT_EQ(run.violations.list().empty(), role == Role::kInstructor);
  }
}

TEST(AuthorityChecker, ReportsATransferInOneStep) {
  SceneSpec scene = two_hands();
  const double at = 2;
  AuthorityRow row = scene.authority[0];
  std::swap(row.alpha[0], row.alpha[1]);
  ASSERT_NE(row.alpha[0], row.alpha[1]);
  scene.timeline = {{at, row}};
  for (const double slew : {1.0, 1e9}) {
    scene.alpha_slew = slew;
    ObservedRun run{scene};
    run.judged.alpha_slew = 1;
    AuthorityChecker checker{run.judged};
    run.run(5, [&](const ObservedSeat& seat) {
      if (seat.index == 0) checker.check(1, seat.session, {1, 1, 1, 1, 1, 1, 1}, run.violations);
    });
    EXPECT_EQ(run.count("authority_slew") > 0, slew > 1);
  }
}

TEST(SeatEndsChecker, AcceptsChannelsAndReportsALowerApproachSpeed) {
  for (const double v_app : {0.1, -10.0}) {
    ObservedRun run{two_hands()};
    run.judged.channel.v_app = v_app;
    std::map<std::size_t, SeatEndsChecker> checkers;
    run.run_clients(4, [&](const ObservedSeat& seat) {
      checkers[seat.index].check_server(seat);
      checkers[seat.index].check_client(seat);
    });
    EXPECT_EQ(run.count("approach") > 0, v_app < 0);
    EXPECT_EQ(run.count("ledger") + run.count("energy_monotone") + run.count("starved"), 0u);
  }
}

TEST(StarvationChecker, ReportsAReferenceThatRestsFor300Milliseconds) {
  ObservedRun run{two_hands()};
  run.run(3);
  run.judged.gate.force_max = 1e6;  // no motor limits the elongation
  const ObservedSeat seat = run.observed(0);
  const control::ChannelEnd& end = seat.core().tools().end(0);
  const AxisArray ref = end.state().ref;
  PortSample far;
  AxisArray x = ref;
  far.x = ref;
  far.x[0] += 0.1;
  x[0] += 0.1;
  const AxisArray scale = seat.core().setup().axis_scale, no_offset{};
  StarvationChecker checker;
  const auto ticks = [&](int n) {
    for (int i = 0; i < n; ++i) checker.check(seat, {end, scale, far, x, x, ref, no_offset});
    return run.count("starved");
  };
  EXPECT_EQ(ticks(299), 0u);
  checker.skip();
  EXPECT_EQ(ticks(299), 0u) << "counted again from 0";
  EXPECT_GT(ticks(3), 0u);
}

TEST(HandEnergyChecker, AcceptsAHandOfLawReplica) {
  ObservedRun run{test::shipped("free_motion")};
  std::map<std::size_t, HandEnergyChecker> checkers;
  run.run(4, [&](const ObservedSeat& seat) {
    if (seat.master_of_law_replica()) checkers[seat.index].check(seat);
  });
  EXPECT_TRUE(run.violations.list().empty());
}

TEST(HandEnergyBalance, ExceedsItsBoundByUnpaidWork) {
  ObservedRun run{test::shipped("free_motion")};
  HandEnergyBalance balance;
  const auto sample = [&](double work, double unaccountable = 0) {
    return HandEnergyBalance::Sample{.seat = run.observed(0).client.seat(),
                                     .motor_max = 3.3,
                                     .motor_work = work,
                                     .unaccountable_work = unaccountable};
  };
  run.run_clients(4, [&](const ObservedSeat& seat) {
    if (seat.index == 0) static_cast<void>(balance.excess(sample(0)));
  });
  HandEnergyBalance paid = balance, unpaid = balance, excused = balance;
  const double excess = paid.excess(sample(0));
  ASSERT_EQ(run.observed(0).core().gate().phase(), control::GatePhase::kActive);
  EXPECT_NEAR(unpaid.excess(sample(1)), excess + 1, 1e-12);
  EXPECT_NEAR(excused.excess(sample(1, 1)), excess, 1e-12);
}

}  // namespace
}  // namespace tandem::netsim
