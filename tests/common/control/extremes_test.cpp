#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "common/control/channel.h"
#include "common/control/force_gate.h"
#include "common/control/ipc.h"
#include "common/control/tool_copy.h"

/// The laws at extreme parameters, delays and inputs. tests/EXTREMES.md lists what was tried.
namespace tandem::control {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN(),
                 kDenormal = 5e-324;
constexpr double kForceMax = 3.3;

struct Setting {
  std::string_view law;
  double k = 1000, m = 0.02, b = 0.5, T = 0.001;
  int delay = 1;   ///< one way [ticks]
  double age = 0;  ///< stated age of what arrives [s]
  int ticks = 1500;
};
std::string text(const Setting& s) {
  return std::string(s.law) + ", k " + std::to_string(s.k) + ", m " + std::to_string(s.m) + ", b " +
         std::to_string(s.b) + ", T " + std::to_string(s.T) + ", delay " + std::to_string(s.delay);
}

/// A hand that goes its way on one axis, with jumps of 50 mm, on a channel between a client with its gate and a tool.
/// @return what went wrong first; empty: all numbers stayed finite, the motor within its limit and the books exact
std::string run(const Setting& s) {
  ChannelParams p;
  p.dof = 1;
  p.schedule.k = s.k;
  p.schedule.k_min = std::min(60.0, s.k);
  p.k_c = s.k;
  p.effort_max = kForceMax;
  const bool copies = s.law == "replica";
  const auto client = make_channel_end(s.law, p);
  p.side = Side::kServer;
  const auto server = make_channel_end(s.law, p);
  client->engage({}, s.age);
  server->engage({}, s.age);
  MasterIpc ipc;
  ToolIpc tool;
  ToolCopy::Params copy_params;
  copy_params.tool = {s.m, s.b};
  copy_params.axes = 1;
  copy_params.k_c = s.k;
  copy_params.dt = s.T;
  copy_params.force_max = kForceMax;
  copy_params.contacts.add({.normal = {-1, 0, 0}, .at = 0.02, .k = s.k, .b = s.b});
  ToolCopy copy(copy_params);
  copy.rest_at({}, {});
  ForceGate gate({.dof = 1,
                  .force_max = kForceMax,
                  .silence_limit = std::chrono::seconds(10),
                  .loop_age_max = std::chrono::seconds(20),
                  .latch = false});
  std::deque<PortSample> up(static_cast<std::size_t>(s.delay)), down(up);
  Time now{};
  EnergyArray before{};
  double felt = 0;
  for (int i = 0; i < s.ticks; ++i) {
    now += std::max(from_seconds(s.T), Duration(1));
    const double jump = i / 400 % 2 == 1 ? 0.05 : 0;
    AxisArray q{0.03 * std::sin(0.02 * i) + jump}, wanted{};
    EndInput in{.dt = s.T, .age = s.age, .authority = i / 300 % 2 == 0 ? 1.0 : 0.0, .rx = down.front()};
    PortSample sample;
    if (copies) {
      in.x[0] = copy.tool().x(0);
      in.dissipated[0] = copy.dissipated(0);
      client->move(in);
      wanted = copy.step(q, in.authority, *client);
      sample.x[0] = copy.anchor(0).x;
      sample.v[0] = copy.anchor(0).v;
    } else {
      in.x[0] = ipc.x;
      in.dissipated[0] = ipc.dissipated;
      const EndState& e = client->move(in);
      client->credit(0, e.absorbed[0]);
      const MasterIpc::Gains gains{s.k, s.b, s.m};
      ipc.step(gains, s.T, q[0], e.ref[0], e.k[0], e.b[0]);
      wanted[0] = ipc.device_effort(gains, q[0]);
      sample.x[0] = ipc.x;
      sample.v[0] = ipc.v;
      sample.f[0] = e.k[0] * (ipc.x - e.ref[0]);
    }
    client->replace_velocity(sample.v);
    sample.e_in = client->e_in();
    const ForceGate::Output out = gate.step({.now = now, .fresh = true, .engage = true, .wanted = wanted, .q = q});
    if (copies) copy.delivered(out.effort);
    felt = std::max(felt, std::abs(out.effort[0]));
    in.x[0] = tool.x;
    in.dissipated[0] = tool.dissipated;
    in.rx = up.front();
    const EndState& e = server->move(in);
    server->credit(0, e.absorbed[0]);
    ToolIpc::Pull pull;
    pull.spring(e.k[0], e.ref[0]);
    pull.damper(e.b[0], e.rate[0]);
    tool.step({s.m, s.b}, s.T, pull, e.k[0]);
    up.pop_front();
    up.push_back(sample);
    sample = {};
    sample.x[0] = sample.f[0] = tool.x;
    if (!copies) sample.f[0] = e.k[0] * (e.ref[0] - tool.x);
    sample.v[0] = tool.v;
    server->replace_velocity(sample.v);
    sample.e_in = server->e_in();
    down.pop_front();
    down.push_back(sample);

    const EndState& c = client->state();
    for (const double value : {c.ref[0], c.k[0], c.b[0], e.ref[0], e.k[0], e.b[0], tool.x, sample.v[0], wanted[0]})
      if (!std::isfinite(value)) return "not finite at tick " + std::to_string(i);
    if (!(std::abs(out.effort[0]) <= kForceMax * (1 + 1e-12))) return "above the motor's limit";
    const EnergyLedger& book = client->ledger(0);
    if (client->guarantees().ledger && (!book.holds() || book.in_nj() < before[0] || book.out_nj() < before[1]))
      return "books broken at tick " + std::to_string(i);
    before[0] = book.in_nj();
    before[1] = book.out_nj();
  }
  if (!(felt > 0) && s.k * s.T * s.ticks > 1) return "nothing was felt";
  return "";
}

class Extremes : public testing::TestWithParam<const char*> {};

TEST_P(Extremes, OfStiffnessMassDampingAndStepStayFiniteLimitedAndBooked) {
  for (const double k : {1e-3, 1.0, 1e3, 1e8})
    for (const double m : {1e-9, 1e-4, 1.0, 1e3})
      for (const double b : {0.0, 1.0, 1e6})
        for (const double T : {1e-6, 1e-3, 0.1}) {
          const Setting s{.law = GetParam(), .k = k, .m = m, .b = b, .T = T, .ticks = 900};
          EXPECT_EQ(run(s), "") << text(s);
        }
}

TEST_P(Extremes, OfRoundTripsFromZeroTo10SecondsStayFiniteLimitedAndBooked) {
  for (const int delay : {1, 10, 500, 5000}) {
    const Setting s{
        .law = GetParam(), .delay = delay, .age = delay == 1 ? 0 : 0.001 * delay, .ticks = 3000 + 2 * delay};
    EXPECT_EQ(run(s), "") << text(s);
  }
}

/// Every number of an input, by name.
struct Field {
  const char* name;
  void (*set)(EndInput&, double);
};
constexpr Field kFields[] = {
    {"age", [](EndInput& in, double v) { in.age = v; }},
    {"near end", [](EndInput& in, double v) { in.x[0] = v; }},
    {"heat", [](EndInput& in, double v) { in.dissipated[0] = v; }},
    {"authority", [](EndInput& in, double v) { in.authority = v; }},
    {"pull of a slave", [](EndInput& in, double v) { in.slave_pull = v; }},
    {"share passed on", [](EndInput& in, double v) { in.pass_on = v; }},
    {"received position", [](EndInput& in, double v) { in.rx.x[0] = v; }},
    {"received velocity", [](EndInput& in, double v) { in.rx.v[0] = v; }},
    {"received effort", [](EndInput& in, double v) { in.rx.f[0] = v; }},
    {"received acceleration", [](EndInput& in, double v) { in.rx.a[0] = v; }},
};

// One bad number in one tick: everything stays finite, the books stay exact, and the end follows again afterwards.
TEST_P(Extremes, OfEveryInputAreForgotten) {
  for (const Side side : {Side::kClient, Side::kServer}) {
    for (const Field& field : kFields) {
      for (const double bad : {kNaN, kInf, -kInf, 1e300, -1e300, 1e18, kDenormal, -kDenormal, -0.0}) {
        SCOPED_TRACE(std::string(field.name) + " = " + testing::PrintToString(bad) +
                     (side == Side::kClient ? ", client" : ""));
        ChannelParams p;
        p.side = side;
        p.dof = 1;
        p.effort_max = kForceMax;
        const auto end = make_channel_end(GetParam(), p);
        end->engage({}, 0.02);
        EndInput good;
        good.age = 0.02;
        good.authority = 0;
        const auto check = [&] {
          const EndState& e = end->state();
          AxisArray sent{};
          end->replace_velocity(sent);
          for (const double value : {e.ref[0], e.k[0], e.b[0], e.rate[0], e.led[0], e.absorbed[0], e.paid[0], sent[0]})
            EXPECT_TRUE(std::isfinite(value));
          EXPECT_TRUE(end->ledger(0).holds() || !end->guarantees().ledger);
        };
        end->move(good);
        EndInput wrong = good;
        field.set(wrong, bad);
        end->move(wrong);
        check();
        good.rx.x[0] = 0.001;
        if (std::string(GetParam()) == "tdpa") good.rx.f[0] = -1;   // its reference at a client follows a force
        if (std::string(GetParam()) == "wave") good.rx.v[0] = 0.2;  // its reference follows waves of 1 N
        for (int i = 0; i < 4000; ++i) {
          good.rx.e_in[0] += 100'000;  // pays for the waves
          end->move(good);
        }
        check();
        EXPECT_GT(end->state().ref[0], 4e-4) << "follows again";
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Extremes, testing::Values("replica", "set_position", "tdpa", "wave", "pd", "raw"),
                         [](const auto& law) { return std::string(law.param); });

}  // namespace
}  // namespace tandem::control
