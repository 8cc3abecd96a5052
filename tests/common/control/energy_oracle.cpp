#include "tests/common/control/energy_oracle.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/base/rng.h"
#include "common/control/channel.h"
#include "common/control/esc_hub.h"
#include "common/control/ipc.h"
#include "common/control/tool_copy.h"
#include "tests/common/control/held_direction.h"
#include "tests/common/control/hostile_network.h"

namespace tandem::test {
namespace {

using control::ChannelEnd;
using control::ChannelParams;
using control::EndInput;
using control::EndState;
using control::Side;

constexpr double kCoupling = 360;  ///< k_c [N/m]

/// A hand on the handle of a device, one axis: a mass on a spring to where the hand wants to be. The motor's force is
/// held during a tick, and the handle moves in steps of a tenth of it.
struct Hand {
  double m = 0.2, b = 2, k = 100;
  double q = 0, v = 0, wish = 0;
  double motor_work = 0;    ///< given by the motor [J]
  double sampled_work = 0;  ///< of it, what holding the force of a spring k_c over a tick creates: 1/2 k_c dq^2 [J]

  void step(double motor) {
    constexpr int kParts = 10;
    const double before = q;
    for (int i = 0; i < kParts; ++i) {
      v += kT / kParts * (motor - b * v + k * (wish - q)) / m;
      q += kT / kParts * v;
    }
    motor_work += motor * (q - before);
    sampled_work += 0.5 * kCoupling * (q - before) * (q - before);
  }
};
using Hands = std::array<Hand, kDof>;

/// The two ends of a channel and what hangs on them, except for the hand. One tick: `client`, then the hands move, then
/// `sample`, then `server`.
class Ends {
 public:
  Ends() = default;
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
  virtual ~Ends() = default;
  /// @return force of each motor [N]
  virtual AxisArray client(const PortSample& heard, double age, const AxisArray& q) = 0;
  virtual PortSample sample() = 0;  ///< client to server
  virtual PortSample server(const PortSample& heard, double age) = 0;
  [[nodiscard]] virtual double tool(std::size_t axis) const = 0;
  /// Energy granted beyond the initial one, per axis [J], from the motion of the tool alone.
  [[nodiscard]] virtual double granted(std::size_t) const { return 0; }
};

ChannelParams params_of(const Trial& trial, Side side) {
  ChannelParams p;
  p.side = side;
  p.dof = kDof;
  p.e0 = trial.unlimited ? 1e3 : kInitialEnergy;
  p.margin_max = trial.unlimited ? 1e4 : 0.1;
  p.effort_max = kMotorMax;
  p.k_c = kCoupling;
  return p;
}

/// All laws but `replica`: virtual mass and channel end at the client, channel end and tool at the server.
class SpringEnds final : public Ends {
 public:
  SpringEnds(const Trial& trial, double wall)
      : wall_(wall),
        client_(control::make_channel_end(trial.law, params_of(trial, Side::kClient))),
        server_(control::make_channel_end(trial.law, params_of(trial, Side::kServer))) {
    client_->engage({}, 0.05);
    server_->engage({}, 0.05);
  }
  AxisArray client(const PortSample& heard, double age, const AxisArray& q) override {
    EndInput in{.dt = kT, .age = age, .rx = heard};
    for (std::size_t a = 0; a < kDof; ++a) {
      in.x[a] = ipc_[a].x;
      in.dissipated[a] = ipc_[a].dissipated;
    }
    const EndState& s = client_->move(in);
    AxisArray motor{};
    for (std::size_t a = 0; a < kDof; ++a) {
      client_->credit(a, s.absorbed[a]);
      const control::MasterIpc::Gains gains{kCoupling, 0.5, 0.02};
      ipc_[a].step(gains, kT, q[a], s.ref[a], s.k[a], s.b[a]);
      motor[a] = ipc_[a].device_effort(gains, q[a]);
    }
    return motor;
  }
  PortSample sample() override {
    PortSample out;
    const EndState& s = client_->state();
    for (std::size_t a = 0; a < kDof; ++a) {
      out.x[a] = ipc_[a].x;
      out.v[a] = ipc_[a].v;
      out.f[a] = s.k[a] * (ipc_[a].x - s.ref[a]);
    }
    client_->replace_velocity(out.v);
    out.e_in = client_->e_in();
    return out;
  }
  PortSample server(const PortSample& heard, double age) override {
    EndInput in{.dt = kT, .age = age, .rx = heard};
    for (std::size_t a = 0; a < kDof; ++a) {
      in.x[a] = tool_[a].x;
      in.dissipated[a] = tool_[a].dissipated;
    }
    const EndState& s = server_->move(in);
    PortSample out;
    for (std::size_t a = 0; a < kDof; ++a) {
      server_->credit(a, s.absorbed[a]);
      control::ToolIpc::Pull pull;
      pull.spring(s.k[a], s.ref[a]);
      pull.spring(wall_, 0);
      pull.damper(s.b[a], 0);
      tool_[a].step({0.05, 0.2}, kT, pull, s.k[a]);
      out.x[a] = tool_[a].x;
      out.v[a] = tool_[a].v;
      out.f[a] = s.k[a] * (s.ref[a] - tool_[a].x);
    }
    server_->replace_velocity(out.v);
    out.e_in = server_->e_in();
    return out;
  }
  [[nodiscard]] double tool(std::size_t axis) const override { return tool_[axis].x; }

 private:
  double wall_;
  std::unique_ptr<ChannelEnd> client_, server_;
  std::array<control::MasterIpc, kDof> ipc_{};
  std::array<control::ToolIpc, kDof> tool_{};
};

/// Law `replica`: a copy of the tool at the client, the tool at the server, and other hands, which move as they like
/// and have the rest of the authority. The authority changes at any time and travels in `PortSample::a`, which a server
/// does not use.
class CopyEnds final : public Ends {
 public:
  CopyEnds(const Trial& trial, double wall)
      : random_(mix64(trial.seed + 99)),
        grants_(trial.grants),
        client_(control::make_channel_end("replica", params_of(trial, Side::kClient))),
        server_(control::make_channel_end("replica", params_of(trial, Side::kServer))),
        copy_(copy_params(wall)),
        tool_({}, kDof, walls(wall)),
        hub_({.axes = kDof, .masters = 2}) {
    copy_.rest_at({}, {});
    client_->engage({}, 0.05);
    server_->engage({}, 0.05);
    authority_ = draw_authority();
    hub_.set_follow(0, 0, 1);
    for (std::size_t a = 0; a < kDof; ++a) {
      amplitude_[a] = random_.uniform(0, 0.04);
      hz_[a] = random_.uniform(0.2, 6);
    }
  }
  AxisArray client(const PortSample& heard, double age, const AxisArray& q) override {
    EndInput in{.dt = kT, .age = age, .authority = heard.a[0], .rx = heard};
    in.rx.a = {};
    for (std::size_t a = 0; a < kDof; ++a) {
      in.x[a] = copy_.tool().x(a);
      in.dissipated[a] = copy_.dissipated(a);
    }
    client_->move(in);
    AxisArray motor = copy_.step(q, in.authority, *client_);
    double square = 0;
    for (std::size_t a = 0; a < kDof; ++a) square += motor[a] * motor[a];
    if (square > kMotorMax * kMotorMax)
      for (double& f : motor) f *= kMotorMax / std::sqrt(square);
    copy_.delivered(motor);
    return motor;
  }
  PortSample sample() override {
    PortSample out;
    for (std::size_t a = 0; a < kDof; ++a) {
      out.x[a] = copy_.anchor(a).x;
      out.v[a] = copy_.anchor(a).v;
      out.a[a] = copy_.anchor(a).a;
    }
    out.e_in = client_->e_in();
    return out;
  }
  PortSample server(const PortSample& heard, double age) override {
    ++tick_;
    if (random_.below(700) == 0) authority_ = draw_authority();
    if (random_.below(900) == 0) jump_ = random_.uniform(-0.05, 0.05);
    EndInput in{.dt = kT, .age = age, .rx = heard};
    for (std::size_t a = 0; a < kDof; ++a) in.x[a] = tool_.x(a);
    const EndState& s = server_->move(in);
    AxisArray other{}, velocity{};
    control::VirtualTool::Pulls pulls{};
    for (std::size_t a = 0; a < kDof; ++a) {
      const double turn = 2 * 3.141592653589793 * hz_[a], phase = turn * kT * tick_;
      other[a] = jump_ + amplitude_[a] * std::sin(phase);
      velocity[a] = amplitude_[a] * turn * std::cos(phase);
      pulls[a].spring(authority_ * s.k[a], s.ref[a]);
      pulls[a].damper(authority_ * s.b[a], s.rate[a]);
      pulls[a].spring((1 - authority_) * kCoupling, other[a]);
      pulls[a].damper((1 - authority_) * 14, velocity[a]);
    }
    const AxisArray before{tool_.x(0), tool_.x(1), tool_.x(2)};
    tool_.step(kT, pulls);
    PortSample out;
    control::ToolPort port;
    for (std::size_t a = 0; a < kDof; ++a) {
      port.x[a] = out.f[a] = tool_.x(a);
      port.v[a] = tool_.v(a);
      port.moved[a] = tool_.x(a) - before[a];
      out.x[a] = authority_ < 1 ? other[a] : tool_.x(a);
      out.v[a] = authority_ < 1 ? velocity[a] : tool_.v(a);
      granted_[a] += grants_ ? (1 - authority_) * kMotorMax * std::abs(port.moved[a]) : 0;
    }
    if (grants_) {
      const control::MasterArray alpha{authority_, 1 - authority_};
      hub_.set_authority(0, alpha, false);
      hub_.set_tool(0, port);
      hub_.grant_following(0, 0, heard.x, kMotorMax, *server_);
    }
    out.a[0] = authority_;
    out.e_in = server_->e_in();
    return out;
  }
  [[nodiscard]] double tool(std::size_t axis) const override { return tool_.x(axis); }
  [[nodiscard]] double granted(std::size_t axis) const override { return granted_[axis]; }

 private:
  /// A wall on the first two axes; the third is free.
  static control::ContactSet walls(double k) {
    control::ContactSet all;
    if (k > 0)
      for (std::size_t a = 0; a < 2; ++a) {
        control::Contact contact{.k = k, .b = 1};
        contact.normal[a] = -1;
        all.add(contact);
      }
    return all;
  }
  static control::ToolCopy::Params copy_params(double wall) {
    control::ToolCopy::Params p;
    p.axes = kDof;
    p.k_c = kCoupling;
    p.force_max = kMotorMax;
    p.contacts = walls(wall);
    return p;
  }
  double draw_authority() {
    const auto kind = random_.below(4);
    return kind == 0 ? 1 : kind < 3 ? 0 : random_.uniform();
  }

  RandomStream random_;
  bool grants_;
  std::unique_ptr<ChannelEnd> client_, server_;
  control::ToolCopy copy_;
  control::VirtualTool tool_;
  control::EscHub hub_;
  double authority_ = 1, jump_ = 0;
  int tick_ = 0;
  std::array<double, kDof> amplitude_{}, hz_{};
  AxisArray granted_{};
};

/// Replaces positions and velocities of a sample for a while, as a server does whose tool jumps. The energies stay
/// true.
class Liar {
 public:
  explicit Liar(std::uint64_t seed) : random_(seed) {}
  [[nodiscard]] PortSample told(PortSample sample) {
    if (left_ > 0) {
      --left_;
    } else if (random_.below(400) == 0) {
      left_ = 20 + static_cast<int>(random_.below(200));
      for (std::size_t a = 0; a < kDof; ++a) {
        x_[a] = random_.uniform(-0.05, 0.05);
        v_[a] = random_.uniform(-0.3, 0.3);
      }
    }
    for (std::size_t a = 0; left_ > 0 && a < kDof; ++a) {
      sample.x[a] += x_[a];
      sample.v[a] += v_[a];
    }
    return sample;
  }

 private:
  RandomStream random_;
  int left_ = 0;
  AxisArray x_{}, v_{};
};

}  // namespace

double stated_bound(std::string_view law) {
  if (law == "replica") return kDof * kInitialEnergy;
  if (law == "pd" || law == "raw") return std::numeric_limits<double>::infinity();
  return 2 * kDof * kInitialEnergy;
}

Verdict judge(const Trial& trial) {
  RandomStream random{mix64(trial.seed)};
  Enemy up(mix64(trial.seed + 17)), down(mix64(trial.seed + 1000003));
  if (trial.delay > 0) up = Enemy(trial.seed, trial.delay), down = Enemy(trial.seed, trial.delay);
  Hands hands{};
  for (Hand& hand : hands) {
    hand.m = random.uniform(0.08, 0.5);
    hand.b = random.uniform(0.1, 5);
    hand.k = random.below(3) == 0 ? 0 : random.uniform(20, 800);
    hand.v = random.uniform(-0.3, 0.3);
  }
  const double wall = random.below(2) == 0 ? 0 : random.uniform(50, 5000);
  std::unique_ptr<Ends> ends;
  if (trial.law == "replica") {
    ends = std::make_unique<CopyEnds>(trial, wall);
  } else {
    ends = std::make_unique<SpringEnds>(trial, wall);
  }
  PortSample at_client, at_server;
  at_client.a[0] = 1;  // before the first datagram: alone
  double client_age = 0.05, server_age = 0.05;
  Liar to_client(mix64(trial.seed + 5)), to_server(mix64(trial.seed + 6));
  const bool lies = trial.delay == 0;
  HeldDirection upward(trial, false, kCoupling), downward(trial, true, kCoupling);
  const double bound = stated_bound(trial.law);
  Verdict out;
  for (int now = 0; now < trial.ticks; ++now) {
    client_age += kT;
    if (const auto got = down.receive(now)) {
      at_client = *got;
      client_age = down.age_at_arrival;
      downward.received(at_client);
    }
    const double client_held = downward.predict(at_client);
    AxisArray q{};
    for (std::size_t a = 0; a < kDof; ++a) q[a] = hands[a].q;
    const AxisArray motor = ends->client(lies ? to_client.told(at_client) : at_client, client_age - client_held, q);
    for (std::size_t a = 0; a < kDof; ++a) {
      if (random.below(1500) == 0) hands[a].wish = random.uniform(-0.1, 0.1);
      hands[a].step(motor[a]);
    }
    if (const PortSample sample = ends->sample(); upward.due(now, sample)) up.send(now, sample);

    server_age += kT;
    if (const auto got = up.receive(now)) {
      at_server = *got;
      server_age = up.age_at_arrival;
      upward.received(at_server);
    }
    const double server_held = upward.predict(at_server);
    const PortSample target = ends->server(lies ? to_server.told(at_server) : at_server, server_age - server_held);
    if (downward.due(now, target)) down.send(now, target);

    double given = 0, granted = 0;
    for (std::size_t a = 0; a < kDof; ++a) {
      const double axis = hands[a].motor_work - hands[a].sampled_work;
      given += axis;
      granted += ends->granted(a);
      out.worst_axis = std::max(out.worst_axis, axis);
      out.moved = std::max(out.moved, std::abs(ends->tool(a)));
      out.finite &= std::isfinite(ends->tool(a)) && std::isfinite(hands[a].q);
    }
    out.given = std::max(out.given, given);
    out.excess = std::max(out.excess, given - bound - granted);
  }
  out.sent = 0.5 * (upward.share() + downward.share());
  return out;
}

}  // namespace tandem::test
