#include "tests/common/control/stability_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <memory>
#include <numbers>

#include "common/base/format.h"
#include "common/base/stiffness_limit.h"
#include "common/control/channel_raw.h"
#include "common/control/channel_replica.h"
#include "common/control/hand_coupling.h"
#include "common/control/ipc.h"
#include "common/control/tool_copy.h"
#include "tests/common/control/linear_loop.h"

namespace tandem::test {
namespace {

using control::MasterIpc;
using control::ToolIpc;

constexpr int kSteps = 5;  ///< of the bisection of an experiment: to 1.25^(1/32), 0.7 %
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The handle of a device: a mass with damping under a held force, in many small steps of the simulation.
struct Handle {
  double m = 0.045, b = 0.1, k = 0, coulomb = 0;
  double q = 1e-5, v = 0;
  void step(double T, double force) {
    const int parts = coulomb == 0 ? 12 : 64;
    const double h = T / parts;
    for (int i = 0; i < parts; ++i) {
      if (coulomb == 0) {  // midpoint rule: second order, and without damping of its own
        const double w = (m - 0.5 * h * b - 0.25 * h * h * k) * v + h * (force - k * q);
        const double next = w / (m + 0.5 * h * b + 0.25 * h * h * k);
        q += 0.5 * h * (v + next);
        v = next;
        continue;
      }
      const double free = v + h / m * (force - b * v - k * q), grip = h / m * coulomb;
      v = std::abs(free) <= grip ? 0 : free - std::copysign(grip, free);
      q += h * v;
    }
  }
};

/// The force of a device's spring: product code, with its virtual mass on a reference of stiffness k at 0.
struct IpcSpring {
  MasterIpc::Gains gains{0, 0.5, 0.02};
  double k = 1e9;
  MasterIpc ipc{};
  double force(double T, double q) {
    ipc.step(gains, T, q, 0, k, 0);
    return ipc.device_effort(gains, q);
  }
};

/// Does a handle on the spring, whose force comes `delay` ticks late, come to rest?
bool settles(Handle handle, IpcSpring spring, double T, int delay) {
  std::deque<double> late(static_cast<std::size_t>(delay), 0);
  std::vector<double> q;
  for (int i = 0; i < 6000 + 200 * delay; ++i) {
    late.push_back(spring.force(T, handle.q));
    handle.step(T, late.front());
    late.pop_front();
    q.push_back(handle.q);
  }
  return !grows(q);
}

double exact_spring_limit(const Handle& handle, const IpcSpring& spring, double T, int delay) {
  return stability_limit(0.5 * stiffness_limit(handle.b, delay * T, T), 1e5, [&](double k_c) {
    LinearLoop loop(4 + std::max(delay, 1));  // handle q, v; virtual mass x, v; late forces
    const auto x = loop.implicit_mass(2, spring.gains.m_c, spring.gains.b, k_c + spring.k, T, k_c * loop.now(0));
    const LinearLoop::Expression force = -k_c * (loop.now(0) - x);
    loop.held_mass(0, handle.m, handle.b, handle.k, T, delay > 0 ? loop.delayed(4, delay, force) : force);
    return loop.spectral_radius() < 1;
  });
}

StabilityRow spring_row(const char* family, Handle handle, IpcSpring spring, double T, int delay) {
  StabilityRow row{.family = family,
                   .loop = format("m %g kg, b %g N s/m, T %g ms, delay %d ms", handle.m, handle.b, 1e3 * T,
                                  static_cast<int>(std::lround(1e3 * delay * T))),
                   .unit = "N/m"};
  row.exact = exact_spring_limit(handle, spring, T, delay);
  row.closed_form = stiffness_limit(handle.b, delay * T, T);
  row.experiment = stability_limit(
      0.5 * row.closed_form, 1e5,
      [&](double k_c) {
        IpcSpring own = spring;
        own.gains.k_c = k_c;
        return settles(handle, own, T, delay);
      },
      kSteps);
  return row;
}

}  // namespace

std::vector<StabilityRow> colgate_schenkel_rows() {
  return {spring_row("Colgate-Schenkel", {.m = 0.045, .b = 0.1}, {}, 0.001, 0),
          spring_row("Colgate-Schenkel", {.m = 0.1, .b = 0.2}, {}, 0.001, 0),
          spring_row("Colgate-Schenkel", {.m = 0.2, .b = 1}, {}, 0.0005, 0),
          spring_row("Colgate-Schenkel", {.m = 0.1, .b = 0.2}, {}, 0.01, 0)};
}

std::vector<StabilityRow> gil_hulin_rows() {
  std::vector<StabilityRow> rows;
  for (const int delay : {1, 5, 20, 50})
    rows.push_back(spring_row("Gil-Hulin", {.m = 0.045, .b = 0.1}, {}, 0.001, delay));
  return rows;
}

/// Above the limit of Colgate and Schenkel a handle with Coulomb friction c is stable for small motion only. The spring
/// creates as much as a negative damping -2 m s, s the growth rate of the loop without friction. Per period of a motion
/// of peak velocity V it gives pi 2 m s V^2 / w, and friction takes 4 c V / w, so V = 2 c / (pi m s).
std::vector<StabilityRow> diolaiti_rows() {
  std::vector<StabilityRow> rows;
  constexpr double T = 0.001;
  for (const double times : {1.5, 2.0, 4.0}) {
    for (const double coulomb : {0.1, 0.5}) {
      const Handle handle{.m = 0.1, .b = 0.2, .coulomb = coulomb};
      const double k_c = times * stiffness_limit(handle.b, 0, T);
      LinearLoop loop(2);
      loop.held_mass(0, handle.m, handle.b, 0, T, -k_c * loop.now(0));
      const double growth = std::log(loop.spectral_radius()) / T;
      StabilityRow row{.family = "Diolaiti",
                       .loop = format("m 0.1 kg, b 0.2 N s/m, friction %g N, spring %g N/m", coulomb, k_c),
                       .unit = "m/s",
                       .friction = true};
      row.exact = 2 * coulomb / (std::numbers::pi * handle.m * growth);
      row.closed_form = coulomb / (0.5 * k_c * T - handle.b);
      row.experiment = stability_limit(
          0.5 * row.closed_form, 100,
          [&](double v) {
            Handle moving = handle;
            moving.q = 0;
            moving.v = v;
            IpcSpring spring;
            spring.gains.k_c = k_c;
            std::vector<double> q;
            for (int i = 0; i < 4000; ++i) {
              moving.step(T, spring.force(T, moving.q));
              q.push_back(moving.q);
            }
            return !grows(q);
          },
          kSteps);
      rows.push_back(row);
    }
  }
  return rows;
}

/// Positions both ways over a constant delay, with damping B at both ends: hand, virtual mass and `RawEnd` at the
/// client, `RawEnd` and tool at the server. Nuno, Ortega, Barabanov, Basanez: 4 B^2 > 2 (k d)^2.
std::vector<StabilityRow> p_plus_d_rows() {
  std::vector<StabilityRow> rows;
  constexpr double T = 0.001, kc = 360, m_c = 0.02, m_s = 0.05;
  const Handle hand{.m = 0.2, .b = 1, .k = 50};
  for (const int delay : {5, 20, 50}) {
    for (const double B : {1.0, 4.0}) {
      StabilityRow row{.family = "P+d",
                       .loop = format("delay %d ms, B %g N s/m at both ends", delay, B),
                       .unit = "N/m",
                       .closed_form = std::numbers::sqrt2 * B / (delay * T)};
      row.exact = stability_limit(0.5 * row.closed_form, 1e5, [&](double k) {
        LinearLoop loop(6 + 2 * delay);  // hand, virtual mass, tool, both ways
        const int up = 6, down = 6 + delay;
        const auto x = loop.implicit_mass(2, m_c, B, kc + k, T, kc * loop.now(0) + k * loop.now(down + delay - 1));
        loop.held_mass(0, hand.m, hand.b, hand.k, T, -kc * (loop.now(0) - x));
        const auto tool = loop.implicit_mass(4, m_s, B, k, T, k * loop.now(up + delay - 1));
        loop.delayed(up, delay, x);
        loop.delayed(down, delay, tool);
        return loop.spectral_radius() < 1;
      });
      row.experiment = stability_limit(
          0.5 * row.closed_form, 1e5,
          [&](double k) {
            control::ChannelParams p;
            p.dof = 1;
            p.schedule.k = k;
            control::RawEnd client(p);
            p.side = control::Side::kServer;
            control::RawEnd server(p);
            client.engage({}, delay * T);
            server.engage({}, delay * T);
            MasterIpc ipc;
            ToolIpc tool;
            Handle handle = hand;
            std::deque<double> up(static_cast<std::size_t>(delay), 0), down(up);
            std::vector<double> q;
            const MasterIpc::Gains gains{kc, B, m_c};
            control::EndInput in;
            in.dt = T;
            in.age = delay * T;
            for (int i = 0; i < 4000 + 320 * delay; ++i) {
              in.x[0] = ipc.x;
              in.rx.x[0] = down.front();
              const double r = client.move(in).ref[0];
              ipc.step(gains, T, handle.q, r, k, 0);
              handle.step(T, ipc.device_effort(gains, handle.q));
              in.x[0] = tool.x;
              in.rx.x[0] = up.front();
              ToolIpc::Pull pull;
              pull.spring(k, server.move(in).ref[0]);
              tool.step({m_s, B}, T, pull, k);
              up.pop_front(), down.pop_front();
              up.push_back(ipc.x), down.push_back(tool.x);
              q.push_back(handle.q);
            }
            return !grows(q);
          },
          kSteps);
      rows.push_back(row);
    }
  }
  return rows;
}

/// `pd_peer`: a spring k between each pair of n hands. Equal hands have two modes. In the common one every target is
/// the hand's own delayed position; where the hands differ, minus that over n - 1. Each is one loop.
std::vector<StabilityRow> peer_rows() {
  std::vector<StabilityRow> rows;
  constexpr double T = 0.001, kc = 400, m_c = 0.02, b_c = 0.5;
  constexpr int kDelay = 10;
  const Handle hand{.m = 0.245, .b = 1.2, .k = 50};
  for (const int n : {2, 3, 4, 6, 8}) {
    StabilityRow row{.family = "pd_peer",
                     .loop = format("%d hands, delay %d ms one way, spring of each pair", n, kDelay),
                     .unit = "N/m",
                     .closed_form = kNone};
    const auto stable = [&](double k, double share) {
      const int line = 2 * kDelay;  // to the server and back; the server computes in between
      LinearLoop loop(4 + line);
      const double total = k * (n - 1);
      const auto x =
          loop.implicit_mass(2, m_c, b_c, kc + total, T, kc * loop.now(0) + total * share * loop.now(4 + line - 1));
      loop.held_mass(0, hand.m, hand.b, hand.k, T, -kc * (loop.now(0) - x));
      loop.delayed(4, line, x);
      return loop.spectral_radius() < 1;
    };
    row.exact = stability_limit(10, 1e4, [&](double k) { return stable(k, 1) && stable(k, -1.0 / (n - 1)); });
    row.experiment = stability_limit(
        10, 1e4,
        [&](double k) {
          const auto hands = static_cast<std::size_t>(n);
          control::ChannelParams p;
          p.dof = 1;
          p.schedule.k = k * (n - 1);
          std::vector<MasterIpc> ipc(hands);
          std::vector<Handle> handles(hands, hand);
          std::deque<std::vector<double>> up(kDelay, std::vector<double>(hands, 0)), down(up);
          std::vector<std::unique_ptr<control::RawEnd>> ends;
          for (std::size_t i = 0; i < hands; ++i) {
            ends.push_back(std::make_unique<control::RawEnd>(p));
            ends[i]->engage({}, 2 * kDelay * T);
            handles[i].q = 1e-5 * (1 + static_cast<double>(i));
          }
          const MasterIpc::Gains gains{kc, b_c, m_c};
          control::EndInput in;
          in.dt = T;
          std::vector<double> q;
          std::vector<control::CoupledBody> bodies(hands);
          for (int t = 0; t < 10000; ++t) {
            std::vector<double> x(hands), target(hands);
            for (std::size_t i = 0; i < hands; ++i) {
              in.x[0] = ipc[i].x;
              in.rx.x[0] = down.front()[i];
              ipc[i].step(gains, T, handles[i].q, ends[i]->move(in).ref[0], p.schedule.k, 0);
              handles[i].step(T, ipc[i].device_effort(gains, handles[i].q));
              x[i] = ipc[i].x;
              bodies[i].x[0] = up.front()[i];
            }
            for (std::size_t i = 0; i < hands; ++i)
              target[i] = control::coupled_target(control::HandCoupling::kPdPeer, {.axes = 1, .k = p.schedule.k},
                                                  bodies, i, {}, {})
                              .x[0];
            up.pop_front(), down.pop_front();
            up.push_back(x), down.push_back(target);
            q.push_back(handles[0].q);
          }
          return !grows(q);
        },
        kSteps);
    rows.push_back(row);
  }
  return rows;
}

/// Law `replica`: a leader presses on a surface with 0.5 N; the copy of the tool is stepped with the surface, and its
/// damping relative to the hand is limited there to (b + b_e) k_c / k_e.
std::vector<StabilityRow> replica_rows() {
  std::vector<StabilityRow> rows;
  for (const double T : {0.0005, 0.001, 0.002}) {
    for (const double k_e : {2000.0, 20000.0}) {
      const Handle hand{.m = 0.1, .b = 0.2};
      constexpr double b_e = 0, m = 0.02, b = 0.2, b_rel = 14;
      StabilityRow row{.family = "replica",
                       .loop = format("m 0.1 kg, b 0.2 N s/m, T %g ms, surface %g N/m", 1e3 * T, k_e),
                       .unit = "N/m",
                       .closed_form = stiffness_limit(hand.b, 0, T)};
      row.exact = stability_limit(0.5 * row.closed_form, 1e4, [&](double k_c) {
        LinearLoop loop(6);  // hand q, v; copy x, v; filtered velocity of the hand; its position one tick ago
        const double relative = std::min(b_rel, (b + b_e) * k_c / k_e),
                     pole = 1 - std::exp(-2 * std::numbers::pi * 40 * T);
        const LinearLoop::Expression velocity = (1 - pole) * loop.now(4) + pole / T * (loop.now(0) - loop.now(5));
        const auto x =
            loop.implicit_mass(2, m, b + b_e + relative, k_c + k_e, T, k_c * loop.now(0) + relative * velocity);
        loop.held_mass(0, hand.m, hand.b, 0, T, -k_c * (loop.now(0) - x));
        loop.set(4, velocity);
        loop.set(5, loop.now(0));
        return loop.spectral_radius() < 1;
      });
      row.experiment = stability_limit(
          0.5 * row.closed_form, 1e4,
          [&](double k_c) {
            control::ToolCopy::Params p;
            p.axes = 1;
            p.dt = T;
            p.k_c = k_c;
            p.force_max = 1e6;
            p.contacts.add({.normal = {-1, 0, 0}, .at = 0, .k = k_e, .b = b_e});
            control::ToolCopy copy(p);
            control::ChannelParams channel;
            channel.dof = 1;
            channel.e0 = channel.margin_max = 1e3;
            channel.k_c = k_c;
            control::ReplicaReference end(channel);
            copy.rest_at({}, {});
            end.engage({}, 0);
            Handle handle = hand;
            handle.q = 0;
            std::vector<double> q;
            control::EndInput in;
            in.dt = T;
            const int ticks = static_cast<int>(20 / T);
            for (int i = 0; i < ticks; ++i) {
              in.x[0] = copy.tool().x(0);
              end.move(in);
              const AxisArray motor = copy.step({handle.q}, 1, end);
              copy.delivered(motor);
              // a push that grows within 0.1 s, so that the hand stays on the surface
              handle.step(T, motor[0] + 0.5 * std::min(1.0, i * T / 0.1));
              q.push_back(handle.q);
            }
            return !grows(q);
          },
          kSteps);
      rows.push_back(row);
    }
  }
  return rows;
}

void print(const StabilityRow& row) {
  std::printf("[  limits  ] %-16s %-52s %9.4g %-4s exact %9.4g, ratio %.3f; closed form %9.4g, ratio %.3f\n",
              row.family.c_str(), row.loop.c_str(), row.experiment, row.unit.c_str(), row.exact,
              row.experiment / row.exact, row.closed_form, row.experiment / row.closed_form);
}

}  // namespace tandem::test
