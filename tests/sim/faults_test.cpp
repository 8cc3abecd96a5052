// Faults at the ends of the network: suspended or dead programs, wrong readings, bytes from unknown senders, clocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "netsim/engine/decision_log.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using netsim::Fault;

SceneSpec calm_scene(LawKind law = LawKind::kReplica) {
  SceneSpec scene = (law == LawKind::kReplica ? test::shipped : test::set_position)("free_motion");
  for (auto& s : scene.seats) s.hand.deviations.clear();
  scene.timeline.clear();
  scene.duration = 12;
  scene.phases = {{"run", 1, 12, false}};
  return scene;
}

struct Lived {
  std::unique_ptr<netsim::Simulation> simulation;
  std::uint64_t fingerprint = 0;  ///< hash of the position of every hand at every tick
  std::uint64_t faulted_ticks = 0;
};

Lived live(netsim::SimulationConfig setup, const test::Observer& observer = {}) {
  auto made = netsim::Simulation::make(setup);
  if (!made) throw std::runtime_error(made.error());
  Lived out{std::move(*made)};
  while (out.simulation->step()) {
    for (std::size_t i = 0; i < out.simulation->scene().seats.size(); ++i)
      out.fingerprint =
          mix64(out.fingerprint ^ std::bit_cast<std::uint64_t>(out.simulation->device(i).ground_truth().x[0]));
    if (observer) observer(*out.simulation);
  }
  return out;
}

netsim::SimulationConfig with_fault(Fault::Kind kind, Duration length, const std::string& seat = "trainee",
                                    LawKind law = LawKind::kReplica) {
  netsim::SimulationConfig setup{.scene = calm_scene(law)};
  setup.faults = {{kind, seat, 5s, length}};
  return setup;
}

void expect_nothing_broken(const netsim::Simulation& simulation) {
  EXPECT_EQ(simulation.trouble(), "");
  for (const auto& v : simulation.violations().list())
    EXPECT_TRUE(v.expected) << v.invariant << " " << v.seat << " at " << v.at_s;
}

constexpr std::size_t kTrainer = 0, kTrainee = 1;

TEST(Faults, ReleaseTheHandOfAPausedProgramAndEngageItAgain) {
  Duration let_go_after{};
  const Lived run = live(with_fault(Fault::Kind::kPause, 500ms), [&](netsim::Simulation& w) {
    // The device drops its command by itself, 5 ms after the program's last command.
    const Duration into = w.now() - (Time{} + 5s);
    if (into > 6ms && into < 490ms) {
      EXPECT_EQ(w.device(kTrainee).state().f_out.norm(), 0) << seconds(into);
    }
    if (let_go_after == Duration{} && into > 0s && !w.seat(kTrainee)->gate().active()) let_go_after = into;
  });
  expect_nothing_broken(*run.simulation);
  EXPECT_EQ(run.simulation->seat(kTrainee)->gate().trips(), 1u);
  EXPECT_EQ(run.simulation->seat(kTrainer)->gate().trips(), 0u) << "the others are not to suffer";
  EXPECT_EQ(run.simulation->device(kTrainee).counts().expired, 496u)
      << "the command of 4.999 s lives until 5.004 s, the next comes at 5.500 s";
  EXPECT_GE(let_go_after, 500ms) << "no client ran that could have released the hand before";
}

TEST(Faults, RestoreSeatAndEngagementOfARestartedProgram) {
  bool gone = false, back = false;
  const Lived run = live(with_fault(Fault::Kind::kRestart, 1s), [&](netsim::Simulation& w) {
    gone |= w.seat(kTrainee) == nullptr;
    back |= gone && w.seat(kTrainee) != nullptr && w.seat(kTrainee)->gate().phase() == control::GatePhase::kActive;
  });
  expect_nothing_broken(*run.simulation);
  EXPECT_TRUE(gone);
  EXPECT_TRUE(back);
}

TEST(Faults, WrongReadingsAreHeldForThreeSamplesThenFaultOneSeat) {
  for (const auto kind : {Fault::Kind::kNotANumber, Fault::Kind::kOutOfRange}) {
    const Lived shortly = live(with_fault(kind, 3ms));
    expect_nothing_broken(*shortly.simulation);
    EXPECT_EQ(shortly.simulation->seat(kTrainee)->gate().phase(), control::GatePhase::kReleasing)
        << "the session's end, not FAULT";
    EXPECT_EQ(shortly.simulation->seat(kTrainee)->gate().trips(), 0u);

    Duration faulted{};
    const Lived longer = live(with_fault(kind, 10ms), [&](netsim::Simulation& w) {
      const auto phase = w.seat(kTrainee) ? w.seat(kTrainee)->gate().phase() : control::GatePhase::kOff;
      if (faulted == Duration{} && phase == control::GatePhase::kFault) faulted = w.now() - (Time{} + 5s);
    });
    expect_nothing_broken(*longer.simulation);
    EXPECT_EQ(longer.simulation->seat(kTrainee)->gate().phase(), control::GatePhase::kFault);
    EXPECT_EQ(longer.simulation->seat(kTrainer)->gate().trips(), 0u);
    EXPECT_EQ(faulted, 4ms) << "the fourth wrong sample, seen after its tick";
  }
}

TEST(Faults, ReplayedAndRandomDatagramsChangeNothingAtAll) {
  netsim::SimulationConfig clean{.scene = calm_scene()};
  clean.network = netsim::link_from(test::delayed(10, 5, 2));
  netsim::SimulationConfig attacked = clean;
  attacked.faults = {{Fault::Kind::kReplay, "", 1s, 9s}, {Fault::Kind::kJunk, "", 1s, 9s}};
  const Lived quiet = live(clean), loud = live(attacked);
  expect_nothing_broken(*loud.simulation);
  EXPECT_EQ(quiet.fingerprint, loud.fingerprint) << "a hand moved by what an attacker sent";
  EXPECT_EQ(quiet.simulation->session().unmatched_datagrams(), 0u);
  EXPECT_GT(loud.simulation->session().unmatched_datagrams(), 18'000u) << "nothing was sent";
  const auto& refused = loud.simulation->session().seat(kTrainee).link()->stats().dropped;
  EXPECT_GT(refused[static_cast<std::size_t>(transport::DropReason::kDuplicate)] +
                refused[static_cast<std::size_t>(transport::DropReason::kTooOld)],
            8000u);
}

TEST(Faults, GainNoEnergyByADecreasingAccount) {
  for (const LawKind law : {LawKind::kSetPosition, LawKind::kReplica}) {
    const Lived honest = live(with_fault(Fault::Kind::kLiar, 1ms, "trainee", law));
    const Lived run = live(with_fault(Fault::Kind::kLiar, 5s, "trainee", law));
    expect_nothing_broken(*run.simulation);
    bool seen = false;
    for (const auto& v : run.simulation->violations().list())
      seen |= v.invariant == "energy_monotone" && v.seat == "trainee" && v.expected;
    EXPECT_EQ(seen, law == LawKind::kSetPosition)
        << "under law replica no end at the server lives on a follower's account";
    EXPECT_GT(honest.simulation->session().clock().time(), 11.9);
  }
}

TEST(Faults, ReleaseHandsDuringAServerPauseAndDropExcessTicks) {
  const Lived run = live(with_fault(Fault::Kind::kServerLate, 600ms, ""));
  expect_nothing_broken(*run.simulation);
  EXPECT_EQ(run.simulation->seat(kTrainer)->gate().trips(), 1u);
  EXPECT_EQ(run.simulation->seat(kTrainee)->gate().trips(), 1u);
  EXPECT_EQ(run.simulation->session().clock().dropped_ticks(), 550u)
      << "it lives through 50 missed ticks, gives up the rest";
}

// A motion of 46 mm while the session time was paused appears as 9 m/s.
TEST(Faults, ReportNoHandSpeedFromDroppedTicks) {
  const auto setup = with_fault(Fault::Kind::kServerLate, 300ms, "");
  std::optional<server::ReportBuilder> judge;
  const Lived run = live(setup, [&](netsim::Simulation& w) {
    if (!judge) judge.emplace(w.session().scene());
    judge->add(w.record());
  });
  const auto report = judge->build(std::vector<server::LinkReport>(run.simulation->session().scene().seats.size()));
  EXPECT_GT(report.seats[kTrainer].metrics.speed_peak_m_s, 0.05);
  EXPECT_LT(report.seats[kTrainer].metrics.speed_peak_m_s, 0.6);
  EXPECT_LT(report.seats[kTrainee].metrics.speed_peak_m_s, 0.6);
}

TEST(Clocks, AnOffsetOfADayChangesNothingAtAll) {
  netsim::SimulationConfig same{.scene = calm_scene()};
  netsim::SimulationConfig other = same;
  other.endpoints["trainee"].offset = std::chrono::hours(24);
  other.endpoints["trainer"].offset = -std::chrono::hours(24);
  const Lived a = live(same), b = live(other);
  expect_nothing_broken(*b.simulation);
  EXPECT_EQ(a.fingerprint, b.fingerprint);
}

TEST(Clocks, ReleaseNoHandUnderDriftAndLateWakeUps) {
  netsim::SimulationConfig setup{.scene = calm_scene()};
  setup.endpoints["trainee"] = {.drift_ppm = 200, .wake = {.kind = netsim::WakeSpec::Kind::kMeasured}};
  setup.endpoints["trainer"] = {.drift_ppm = -200,
                                .wake = {.kind = netsim::WakeSpec::Kind::kUniform, .late_max = 900us}};
  const Lived run = live(setup);
  expect_nothing_broken(*run.simulation);
  EXPECT_EQ(run.simulation->seat(kTrainer)->gate().trips(), 0u);
  EXPECT_EQ(run.simulation->seat(kTrainee)->gate().trips(), 0u);
}

/// Send times by seat, and the transit times of the datagrams.
struct SentUp : netsim::DecisionSink {
  std::map<std::uint32_t, std::set<Time>> in;
  std::set<Duration> took;
  void decided(const netsim::Decision& d) noexcept override {
    if (d.direction != netsim::Direction::kUp) return;
    in[d.flow].insert(d.in);
    took.insert(d.out - d.in);
  }
};

constexpr netsim::WakeSpec kLate{.kind = netsim::WakeSpec::Kind::kUniform, .late_max = 900us};

/// Returns when a seat's program wakes up until `end`, from the same draws as in the Simulation.
std::set<Time> wakes_of(std::size_t seat, Duration tick, Time end) {
  netsim::WakeUps wakes{kLate, tick, Time{}, RandomKey{1}.derive(1000 + seat).derive(3)};
  std::set<Time> all;
  while (wakes.next() <= end) {
    all.insert(wakes.next());
    static_cast<void>(wakes.due(wakes.next()));
  }
  return all;
}

// A wake-up that is 0.3 ms late sends its datagram 0.3 ms later, not at the next tick.
TEST(Clocks, ALateWakeUpShiftsItsDatagramToTheNanosecond) {
  netsim::SimulationConfig setup{.scene = calm_scene()};
  setup.scene.duration = 3;
  setup.endpoints["trainee"].wake = kLate;
  const Duration tick = 1ms;
  SentUp sent;
  auto made = netsim::Simulation::make(setup);
  ASSERT_TRUE(made);
  (*made)->network().log_to(&sent);
  while ((*made)->step()) {
  }
  expect_nothing_broken(**made);
  const std::set<Time> meant = wakes_of(kTrainee, tick, (*made)->now());
  const auto& late = sent.in[kTrainee];
  EXPECT_TRUE(std::ranges::includes(meant, late)) << "a datagram left when its program slept";
  const auto missing = static_cast<std::ptrdiff_t>(meant.size()) - static_cast<std::ptrdiff_t>(late.size());
  EXPECT_LT(missing, 300) << "only until the seat is taken, and after the session's end, a wake-up may send nothing";
  EXPECT_GT(late.size(), 2900u);
  EXPECT_TRUE(std::ranges::none_of(late, [&](Time t) { return t.time_since_epoch() % tick == Duration{}; }));
  EXPECT_TRUE(std::ranges::all_of(sent.in[kTrainer], [&](Time t) { return t.time_since_epoch() % tick == Duration{}; }))
      << "a client that is not late works at the ticks";
}

// If the Simulation ran seats out of order, a datagram on a shared link would wait for a newer one.
TEST(Clocks, SeatsThatWakeUpLateEnterASharedLinkInTheOrderOfTheirTimes) {
  netsim::SimulationConfig setup{.scene = calm_scene()};
  setup.scene.duration = 3;
  setup.network.up.floor = setup.network.down.floor = 5ms;
  setup.network.shared = true;
  setup.endpoints["trainee"].wake = setup.endpoints["trainer"].wake = kLate;
  SentUp sent;
  auto made = netsim::Simulation::make(setup);
  ASSERT_TRUE(made);
  (*made)->network().log_to(&sent);
  while ((*made)->step()) {
  }
  expect_nothing_broken(**made);
  EXPECT_GT(sent.in[kTrainer].size() + sent.in[kTrainee].size(), 5800u);
  EXPECT_EQ(sent.took, std::set<Duration>{5ms});
}

// A program reads the device's position at the moment of its wake-up. Within a millisecond a hand moves along a
// straight line.
TEST(Clocks, ALateWakeUpReadsTheDeviceAtItsOwnMoment) {
  netsim::SimulationConfig setup{.scene = calm_scene()};
  setup.scene.duration = 6;
  for (auto& s : setup.scene.seats) s.device.encoder = 0;
  setup.endpoints["trainer"].wake = kLate;
  const std::set<Time> meant = wakes_of(kTrainer, 1ms, Time{30s});
  hal::Vec3 before = hal::Vec3::Zero();
  double off = 0, off_if_at_tick = 0;
  const Lived run = live(setup, [&](netsim::Simulation& w) {
    const hal::Vec3 now = w.device(kTrainer).ground_truth().x;
    const Time end = w.now() - 1ms;  // of the previous tick
    const auto woke = meant.upper_bound(end - 1ms);
    if (w.session().clock().time() > 1 && woke != meant.end() && *woke < end) {
      const auto& read = w.seat(kTrainer)->sample().telemetry.x;
      const hal::Vec3 x{read[0], read[1], read[2]};
      off += (x - (before + seconds(*woke - (end - 1ms)) / 1e-3 * (now - before))).norm();
      off_if_at_tick += (x - now).norm();
    }
    before = now;
  });
  expect_nothing_broken(*run.simulation);
  EXPECT_GT(off_if_at_tick, 0.05) << "[m] in all: no hand moved";
  EXPECT_LT(off, 0.1 * off_if_at_tick);
}

TEST(Clocks, ReleaseTheHandOnceForAStepOfASecond) {
  netsim::SimulationConfig setup{.scene = calm_scene()};
  setup.endpoints["trainee"].steps = {{5s, 1s}};
  const Lived run = live(setup);
  expect_nothing_broken(*run.simulation);
  EXPECT_EQ(run.simulation->seat(kTrainee)->gate().trips(), 1u);
}

TEST(Faults, AreRejectedForAnUnknownSeat) {
  netsim::SimulationConfig setup{.scene = calm_scene()};
  setup.faults = {{Fault::Kind::kPause, "absent", 1s, 1s}};
  const auto made = netsim::Simulation::make(setup);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().find("absent"), std::string::npos);
}

}  // namespace
}  // namespace tandem
