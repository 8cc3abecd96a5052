// Two routes to one number: networked and monolithic, remote and local slave, one run and its repetition.
#include <gtest/gtest.h>

#include <cmath>

#include "common/control/ipc.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using test::delayed;
using test::run;
using test::set_position;
using test::under_both_laws;

TEST(Twins, SameSeedSameTrace) {
  for (const SceneSpec& scene : under_both_laws("free_motion")) {
    const auto net = delayed(20, 10, 10);
    const auto a = run(scene, net, 7), b = run(scene, net, 7), c = run(scene, net, 8);
    EXPECT_EQ(a.report.trace_hash, b.report.trace_hash);
    EXPECT_NE(a.report.trace_hash, c.report.trace_hash) << "the seed does nothing";
    auto plain = [](server::RunReport r) {
      r.cpu_s = 0;
      return server::to_json(r);
    };
    EXPECT_EQ(plain(a.report), plain(b.report));
  }
}

/// Energy Shared Control in one loop, without datagrams, ledgers and gate: springs and masses of common/control/ipc.h,
/// in the order of one tick. With `one_tick`, hands see the tool one tick late, as over the network; otherwise all
/// springs act at once.
class Monolith {
 public:
  Monolith(const SceneSpec& scene, bool one_tick) : scene_(scene), one_tick_(one_tick) {
    for (const auto& s : scene.seats) hands_.push_back(make(s.device, s.hand, {}));
    slave_ = make(scene.tools[0].slave, {}, scene.tools[0].environment);
    for (std::size_t a = 0; a < 3; ++a) {
      tool_[a].x = slave_->state().x[static_cast<Eigen::Index>(a)];
      for (std::size_t i = 0; i < hands_.size(); ++i)
        ipc_[i][a].rest_at(hands_[i]->state().x[static_cast<Eigen::Index>(a)]);
    }
  }
  void step(double t, const std::array<double, 2>& alpha) {
    const double T = 1e-3, k = scene_.channel.k, lead = one_tick_ ? 0.5e-3 : 0;
    std::array<AxisArray, 2> effort{};
    AxisArray pull_slave{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto e = static_cast<Eigen::Index>(a);
      const control::ToolIpc before = tool_[a];
      control::ToolIpc::Pull pull;
      pull.spring(scene_.tools[0].k_s, slave_->state().x[e]);
      const auto move_hand = [&](std::size_t i, double r) {
        const control::MasterIpc::Gains g{scene_.coupling.k_c, scene_.coupling.b, scene_.coupling.m_c};
        ipc_[i][a].step(g, T, hands_[i]->state().x[e], r, k, 0);
        effort[i][a] = ipc_[i][a].device_effort(g, hands_[i]->state().x[e]);
      };
      for (std::size_t i = 0; i < 2; ++i) move_hand(i, before.x + lead * before.v);
      for (std::size_t i = 0; i < 2; ++i) pull.spring(alpha[i] * k, ipc_[i][a].x + lead * ipc_[i][a].v);
      tool_[a].step({scene_.tools[0].m_s, scene_.tools[0].b_s}, T, pull, 0);
      pull_slave[a] = scene_.tools[0].k_s * (tool_[a].x - slave_->state().x[e]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      hands_[i]->set_session_time(t);
      advance(*hands_[i], effort[i]);
    }
    advance(*slave_, pull_slave);
  }
  [[nodiscard]] hal::Vec3 hand(std::size_t i) const { return hands_[i]->ground_truth().x; }
  [[nodiscard]] hal::Vec3 slave() const { return slave_->ground_truth().x; }

 private:
  static std::unique_ptr<hal::sim::SimDevice> make(const SimDeviceSpec& d, const HandSpec& h,
                                                   const EnvironmentSpec& e) {
    return std::move(*hal::sim::SimDevice::make({d, h, e, nullptr, Time{}}));
  }
  static void advance(hal::sim::SimDevice& d, const AxisArray& effort) {
    hal::Command c;
    c.kind = hal::CommandKind::kJointEffort;
    c.expires = d.state().sampled_at + std::chrono::seconds(1);
    c.effort = hal::PortMap(PortSpace::kTip, 3, 3).joint_effort(d.state(), effort);
    d.advance(c, std::chrono::milliseconds(1));
  }
  SceneSpec scene_;
  bool one_tick_;
  std::vector<std::unique_ptr<hal::sim::SimDevice>> hands_;
  std::unique_ptr<hal::sim::SimDevice> slave_;
  std::array<std::array<control::MasterIpc, 3>, 2> ipc_{};
  std::array<control::ToolIpc, 3> tool_{};
};

SceneSpec calm_free_motion() {
  SceneSpec scene = set_position("free_motion");
  for (auto& s : scene.seats) s.hand.deviations.clear();
  scene.duration = 10;
  scene.timeline.clear();
  scene.seats[0].hand.until = 1e6;
  scene.seats[1].hand.from = 1e6;
  return scene;
}

/// Returns the largest distance of two paths at the best shift of up to three ticks. Hands of a session learn its time
/// to within a tick.
double apart(const std::vector<hal::Vec3>& a, const std::vector<hal::Vec3>& b) {
  double least = 1e9;
  for (int shift = -3; shift <= 3; ++shift) {
    double most = 0;
    for (std::size_t k = 3; k + 3 < std::min(a.size(), b.size()); ++k)
      most = std::max(most, (a[k] - b[static_cast<std::size_t>(static_cast<int>(k) + shift)]).norm());
    least = std::min(least, most);
  }
  return least;
}

TEST(Twins, MatchTheMonolithicSystemWithoutNetworkDelay) {
  const SceneSpec scene = calm_free_motion();
  Monolith twin{scene, true}, simultaneous{scene, false};
  std::array<std::vector<hal::Vec3>, 3> networked, monolithic;  // leader, follower, slave
  double square = 0, square_twin = 0, square_once = 0;
  const auto r = run(scene, {}, 1, [&](netsim::Simulation& w) {
    if (!w.record().running) return;
    const double t = w.session().clock().time();
    twin.step(t, {1, 0});
    simultaneous.step(t, {1, 0});
    if (t < 5) return;  // the ramp-in is part of the gate, not of the law
    const hal::Vec3 slave{w.record().tools[0].x[0], w.record().tools[0].x[1], w.record().tools[0].x[2]};
    for (std::size_t i = 0; i < 2; ++i) {
      networked[i].push_back(w.device(i).ground_truth().x);
      monolithic[i].push_back(twin.hand(i));
    }
    networked[2].push_back(slave);
    monolithic[2].push_back(twin.slave());
    square += (w.device(0).ground_truth().x - slave).squaredNorm();
    square_twin += (twin.hand(0) - twin.slave()).squaredNorm();
    square_once += (simultaneous.hand(0) - simultaneous.slave()).squaredNorm();
  });
  ASSERT_TRUE(r.report.passed);
  const auto n = static_cast<double>(networked[0].size());
  ASSERT_GT(n, 4000);
  // Encoder steps occur at different times (0.055 mm at the tip, each hand its own); nothing else differs.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(apart(networked[i], monolithic[i]), 0.25e-3) << i;
  EXPECT_NEAR(std::sqrt(square / n), std::sqrt(square_twin / n), 0.05e-3);
  EXPECT_LE(std::sqrt(square / n), std::sqrt(square_once / n) + 0.8e-3) << "k T drag of the two ticks";
}

TEST(Twins, ARemoteSlaveFollowsTheServersWithinTheDragOfItsExtraTick) {
  // With the extra tick the slave receives the tool's position T later (v T). It drags the tool by k_s v T, which the
  // seat's spring k bears.
  const SceneSpec local = calm_free_motion();
  SceneSpec remote = local;
  SeatSpec slave;
  slave.name = "slave";
  slave.kind = SeatKind::kSlave;
  slave.tool = 0;
  slave.device = local.tools[0].slave;
  remote.seats.push_back(slave);
  remote.tools[0].remote = true;
  remote.tools[0].seat = 2;
  std::vector<hal::Vec3> path;
  const auto a = run(local, {}, 1, [&](netsim::Simulation& w) {
    if (w.record().running)
      path.emplace_back(w.record().tools[0].x[0], w.record().tools[0].x[1], w.record().tools[0].x[2]);
  });
  std::vector<hal::Vec3> remote_path;
  const auto b = run(remote, {}, 1, [&](netsim::Simulation& w) {
    if (w.record().running)
      remote_path.emplace_back(w.record().tools[0].x[0], w.record().tools[0].x[1], w.record().tools[0].x[2]);
  });
  ASSERT_TRUE(a.report.passed);
  ASSERT_TRUE(b.report.passed);
  ASSERT_EQ(path.size(), remote_path.size());
  double apart = 0;
  for (std::size_t k = 3000; k < path.size(); ++k) apart = std::max(apart, (path[k] - remote_path[k]).norm());
  const double v = 2 * 3.14159265 * 0.5 * 0.05, T = 1e-3;  // of the circle
  const double drag = v * T * (1 + local.tools[0].k_s / local.channel.k);
  const double encoder = 2 * 5.5e-5;  // the steps of the two devices occur at different times
  EXPECT_LE(apart, drag + encoder);
  EXPECT_GT(apart, 0) << "the same run twice";
}

}  // namespace
}  // namespace tandem
