#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/rng.h"
#include "common/control/authority.h"
#include "common/control/ipc.h"
#include "tests/common/base/counts.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;

/// Energy Shared Control of one axis with all its sources open, in the order of a tick: IPCs, tool, references follow
/// the tool.
struct Monolith {
  MasterIpc::Gains gains{400, 1, 0.02};
  ToolIpc::Gains tool_gains{0.05, 0.5};
  double k = 1000, k_s = 400, q_s = 0;
  bool implicit = true;  ///< false: the seats' springs act on the tool with last tick's elongation, as printed
  std::vector<MasterIpc> ipc;
  std::vector<double> q, alpha;
  ToolIpc tool;

  [[nodiscard]] double seat_energy(std::size_t i) const { return ipc[i].stored(gains, q[i], tool.x, k); }
  /// V = sum alpha_i V_i + V_slave.
  [[nodiscard]] double storage() const {
    double V = 0.5 * tool_gains.m_s * tool.v * tool.v + 0.5 * k_s * (tool.x - q_s) * (tool.x - q_s);
    for (std::size_t i = 0; i < ipc.size(); ++i) V += alpha[i] * seat_energy(i);
    return V;
  }
  void tick() {
    ToolIpc::Pull pull;
    double printed = 0;
    for (std::size_t i = 0; i < ipc.size(); ++i) {
      ipc[i].step(gains, kT, q[i], tool.x, k, 0);
      if (implicit) pull.spring(alpha[i] * k, ipc[i].x);
      printed += alpha[i] * k * (ipc[i].x - tool.x);
    }
    pull.spring(k_s, q_s);
    if (!implicit) pull.k_anchor += printed;
    tool.step(tool_gains, kT, pull, pull.k - k_s);
  }
};

Monolith random_monolith(RandomStream& random) {
  Monolith m;
  const std::size_t n = 1 + random.below(8);
  m.ipc.resize(n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    m.ipc[i].x = random.uniform(-0.05, 0.05);
    m.ipc[i].v = random.uniform(-0.5, 0.5);
    m.q.push_back(random.uniform(-0.05, 0.05));
    m.alpha.push_back(random.below(4) == 0 ? 0 : random.uniform());
    sum += m.alpha.back();
  }
  if (sum == 0) sum = m.alpha[0] = 1;
  for (double& a : m.alpha) a /= sum;
  m.tool.x = random.uniform(-0.05, 0.05);
  m.tool.v = random.uniform(-0.5, 0.5);
  m.gains = {std::pow(10.0, random.uniform(1, 4)), random.uniform(0, 5), std::pow(10.0, random.uniform(-3, 0))};
  m.k = std::pow(10.0, random.uniform(1, 4));
  m.k_s = std::pow(10.0, random.uniform(1, 4));
  return m;
}

TEST(WeightedStorage, NeverGrowsWithPassiveEndsAndConstantAuthority) {
  const std::uint64_t last = test::seeds(300);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    Monolith m = random_monolith(random);
    double V = m.storage();
    const double first = V;
    for (int tick = 0; tick < 300; ++tick) {
      m.tick();
      ASSERT_LE(m.storage(), V + 1e-13 * first) << "tick " << tick;
      V = m.storage();
    }
  }
}

TEST(WeightedStorage, ReceivesOnlyTheEnergyThatHandsSupply) {
  const std::uint64_t last = test::seeds(100);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    Monolith m = random_monolith(random);
    for (int tick = 0; tick < 300; ++tick) {
      double V = m.storage(), supplied = 0;
      for (std::size_t i = 0; i < m.q.size(); ++i) {
        const double dq = random.uniform(-0.001, 0.001);
        m.q[i] += dq;
        supplied += m.alpha[i] * m.gains.k_c * (m.q[i] - m.ipc[i].x) * dq;
      }
      m.tick();
      ASSERT_LE(m.storage() - V, supplied + 1e-13 * (V + std::abs(supplied))) << "tick " << tick;
    }
  }
}

TEST(WeightedStorage, GrowsWhenTheToolStepIsExplicit) {  // negative control: the test above can fail
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    RandomStream random{seed};
    Monolith m = random_monolith(random);
    m.implicit = false;
    double V = m.storage();
    for (int tick = 0; tick < 300; ++tick) {
      m.tick();
      worst = std::max(worst, m.storage() / V - 1);
      V = m.storage();
    }
  }
  EXPECT_GT(worst, 1e-3);
}

TEST(WeightedStorage, GainsOnlyTankEnergyFromAuthorityChanges) {  // oracle 8, second half
  const std::uint64_t last = test::seeds(50);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    Monolith m = random_monolith(random);
    const std::size_t n = m.ipc.size();
    ToolAuthority row(n, 1.0, 0.05);
    ToolAuthority::Input in;
    for (std::size_t i = 0; i < n; ++i) in.present[i] = true;
    MasterArray wanted{};
    std::copy(m.alpha.begin(), m.alpha.end(), wanted.begin());
    ASSERT_TRUE(row.request(wanted));
    row.step(in);
    double injected = 0, heat = 0;
    for (int tick = 0; tick < 2000; ++tick) {
      if (tick % 100 == 0) {
        wanted.fill(0);
        wanted[random.below(n)] = 1;
        row.request(wanted);
      }
      for (double& q : m.q) q += random.uniform(-0.002, 0.002);  // springs stay loaded
      for (std::size_t i = 0; i < n; ++i) in.stored[i] = m.seat_energy(i);
      in.dissipated = 0.1 * m.tool.dissipated;
      heat += in.dissipated;
      const double before = m.storage();
      row.step(in);
      for (std::size_t i = 0; i < n; ++i) m.alpha[i] = row.alpha(i);
      const double change = m.storage() - before;  // change by alpha alone
      injected += change;
      ASSERT_LE(injected, 0.05 + heat + 1e-9) << "tick " << tick;
      m.tick();
    }
    EXPECT_NEAR(row.injected(), injected, 1e-9 * (1 + std::abs(injected)));  // the row reports the actual energy
  }
}

}  // namespace
}  // namespace tandem::control
