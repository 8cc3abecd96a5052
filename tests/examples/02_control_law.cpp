// A control law of one's own: each end of the channel follows the other end as far as its energy ledger pays; law `raw`
// has no ledger. A spring over a network of 5 ms couples a kicked handle to a tool; without a ledger both fly apart.
//
// Prints:
//   follow: 0.50 m/s at first, 0.00 m/s after 4 s
//   raw: 0.50 m/s at first, 0.79 m/s after 4 s
#include <tandem/control.h>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace tandem;

class FollowEnd final : public control::EnergyBoundedEnd {
 public:
  using EnergyBoundedEnd::EnergyBoundedEnd;
  const control::EndState& move(const control::EndInput& in) noexcept override {
    for (std::size_t a = 0; a < dof(); ++a) {
      ledger_[a].receive(in.rx.e_in[a]);
      state_.absorbed[a] = state_.paid[a] = 0;
      change_stiffness(a, params_.schedule.k, in.x[a], in.weight);
      move_reference(a, in.rx.x[a], in.x[a], in.weight);
    }
    return state_;
  }
  control::Guarantees guarantees() const noexcept override { return {.ledger = true}; }
};

/// A mass at one end of the channel, and the samples that it sent.
struct Side {
  control::ChannelEnd& end;
  double mass, v = 0, x = 0;  // [kg, m/s, m]
  std::vector<PortSample> sent{{}};
  void step(const std::vector<PortSample>& received) {
    const control::EndState& spring =
        end.move({.x = {x}, .rx = received[received.size() > 5 ? received.size() - 5 : 0]});
    end.credit(0, spring.absorbed[0]);
    v += (spring.k[0] * (spring.ref[0] - x) - 0.2 * v) / mass * 0.001;  // damping 0.2 N s/m, tick 1 ms
    x += v * 0.001;
    sent.push_back({.x = {x}, .v = {v}, .e_in = end.e_in()});
  }
};

void run(const char* name, control::ChannelEnd& client, control::ChannelEnd& server) {
  Side handle{client, 0.1, 0.5}, tool{server, 0.05};
  for (int ms = 0; ms < 4000; ++ms) {
    handle.step(tool.sent);
    tool.step(handle.sent);
  }
  std::printf("%s: 0.50 m/s at first, %.2f m/s after 4 s\n", name, std::abs(handle.v));
}

int main() {
  const control::ChannelParams params{.dof = 1, .schedule = {.k = 100}, .e0 = 0.01};
  FollowEnd client{params}, server{params};
  run("follow", client, server);
  run("raw", *control::make_channel_end("raw", params), *control::make_channel_end("raw", params));
}
