#include "tests/sim/resume_cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/base/rng.h"
#include "netsim/feel/drawn_hand.h"
#include "netsim/feel/probes.h"
#include "tests/support/simulation_run.h"

namespace tandem::test {
namespace {

using netsim::Fault;

constexpr double kLength = 20, kMeasured = 5;  // [s]
constexpr double kNear = 0.005;                // [m]
constexpr std::uint64_t kPurpose = 0x726573756d65;

netsim::IntendedPath path_of(Moving moving) {
  switch (moving) {
    case Moving::kCircle:
      return [](double t) {
        const double r = 0.05 * hal::sim::min_jerk(t).value, turn = std::numbers::pi * t;
        return hal::Vec3(r * std::cos(turn), 0, r * std::sin(turn));
      };
    case Moving::kReaches:
      return [](double t) {
        constexpr double kReach = 0.7, kPeriod = 2 * (kReach + 0.5);
        const double in = std::fmod(t, kPeriod);
        const double there = hal::sim::min_jerk(in / kReach).value,
                     back = hal::sim::min_jerk((in - kPeriod / 2) / kReach).value;
        return hal::Vec3(0.1 * (there - back), 0, 0);
      };
    case Moving::kRests:
      return [](double) { return hal::Vec3::Zero().eval(); };
  }
  return {};
}

/// Drives one session whose hands follow the clock of the network: they do not wait for a server that is away.
class Drive {
 public:
  Drive(const ResumeCase& run, bool restart) {
    const RandomKey key = RandomKey{run.seed}.derive(kPurpose);
    at_ = key.uniform(0, 6, 8);
    netsim::SimulationConfig setup{
        .scene = run.law == LawKind::kReplica ? shipped("free_motion") : set_position("free_motion"),
        .network = netsim::link_from(delayed(run.one_way_ms)),
        .seed = run.seed,
        .keep_record = false};
    setup.scene.timeline.clear();
    setup.scene.duration = kLength + 10;
    setup.scene.phases = {{"all", 0, kLength, false}};
    const netsim::DrawnHand leader{netsim::HandKind::kDrawn, run.seed, 0},
        follower{netsim::HandKind::kDrawn, run.seed, 1};
    setup.scene.seats[0].hand = netsim::firm(leader);
    setup.scene.seats[1].hand = netsim::relaxed(follower);
    setup.motions[setup.scene.seats[0].name] = leader.move(path_of(run.moving), kLength);
    if (restart)
      setup.faults = {{Fault::Kind::kServerRestart, "", from_seconds(at_), from_seconds(key.uniform(1, 1, 1.5))}};
    auto made = netsim::Simulation::make(setup);
    if (!made) throw std::runtime_error(made.error());
    simulation_ = std::move(*made);
  }

  Resumed run_from_engagement() {
    std::array<bool, 2> away{};
    std::array<double, 2> since{kLength, kLength};
    return measure([&](std::size_t i) {
      const bool active = simulation_->seat(i)->gate().active();
      if (time() > at_ && !active) away[i] = true;
      if (away[i] && active) since[i] = std::min(since[i], time());
      return since[i];
    });
  }
  Resumed run_from(const Resumed& other) {
    return measure([&](std::size_t i) { return other.hands[i].since - 0.5e-3; });
  }

 private:
  [[nodiscard]] double time() const { return seconds(simulation_->now() - Time{}); }
  void step() {
    if (!simulation_->step()) throw std::runtime_error("the session is over");
    for (std::size_t i = 0; i < 2; ++i) simulation_->device(i).set_session_time(time());
  }
  [[nodiscard]] hal::Vec3 tool() const {
    const AxisArray& x = simulation_->session().tool(0).position();
    return {x[0], x[1], x[2]};
  }

  /// @param since  returns from when on a hand is measured
  template <typename Since>
  Resumed measure(const Since& since) {
    Resumed out;
    std::array<hal::Vec3, 2> before;
    std::array<double, 2> squares{};
    const double ticks = 2 * simulation_->scene().tick_hz;
    double end = kLength + kMeasured;
    while (time() < end) {
      step();
      if (time() < 1) continue;
      const double first = std::min(since(0), since(1));
      const AxisArray& v = simulation_->session().tool(0).velocity();
      if (time() >= first) out.tool_speed = std::max(out.tool_speed, hal::Vec3(v[0], v[1], v[2]).norm());
      for (std::size_t i = 0; i < 2; ++i) {
        const double t = time() - since(i);
        const hal::Vec3 f = simulation_->device(i).state().f_out;
        if (t >= 0) look(i, t, f, (f - before[i]).norm(), out.hands[i]);
        if (t >= 0 && t < 2) squares[i] += f.squaredNorm();
        before[i] = f;
      }
      end = std::max(since(0), since(1)) + kMeasured;
    }
    if (out.hands[0].since == 0 || out.hands[1].since == 0) throw std::runtime_error("a hand was not engaged again");
    for (std::size_t i = 0; i < 2; ++i) out.hands[i].force_rms = std::sqrt(squares[i] / ticks);
    if (!simulation_->trouble().empty()) throw std::runtime_error(simulation_->trouble());
    for (const auto& v : simulation_->violations().list())
      if (!v.expected) throw std::runtime_error("broken: " + v.invariant + " " + v.seat);
    return out;
  }
  [[nodiscard]] double distance(std::size_t i) const {
    return (simulation_->device(i).ground_truth().x - tool()).norm();
  }
  void look(std::size_t i, double t, const hal::Vec3& f, double step, ResumedHand& hand) const {
    const double apart = distance(i);
    if (hand.since == 0) {
      hand.since = time();
      hand.first = f.norm();
      hand.begin = apart;
    }
    hand.step = std::max(hand.step, step);
    hand.force = std::max(hand.force, f.norm());
    hand.distance = std::max(hand.distance, apart);
    if (t >= 2) hand.after_2 = std::max(hand.after_2, apart);
    if (t >= 4) hand.after_4 = std::max(hand.after_4, apart);
    if (apart > kNear) hand.back = t;
  }

  std::unique_ptr<netsim::Simulation> simulation_;
  double at_ = 0;
};

}  // namespace

Resumed resumed(const ResumeCase& run) { return Drive(run, true).run_from_engagement(); }

Resumed undisturbed(const ResumeCase& run, const Resumed& other) { return Drive(run, false).run_from(other); }

}  // namespace tandem::test
