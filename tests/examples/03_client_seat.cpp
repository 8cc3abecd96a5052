// A seat in a program of one's own: joins a running server with a device that is written here. Start a server first:
//   tandem-server run one_axis --duration 2 --listen 127.0.0.1:7000
//   03_client_seat 127.0.0.1:7000
//
// Prints:
//   joined seat trainer, 1000 ticks a second
//   the session runs
//   the session is over after 2 s
#include <tandem/client.h>

#include <cmath>
#include <cstdio>

using namespace tandem;
using namespace std::chrono_literals;

/// A handle of 0.1 kg on a line. A person holds it by a spring and moves by 20 mm at 1 Hz; the motor pulls too.
class Handle final : public hal::SteppedDevice {
 public:
  Handle() {
    caps_.joints = caps_.tip_axes = 1;
    caps_.prismatic = caps_.simulated = true;
    caps_.axis[0].peak = 3.0;
    caps_.damping = 0.2;
    state_.J(0, 0) = 1;
  }
  const hal::DeviceCaps& caps() const noexcept override { return caps_; }
  const hal::State& state() const noexcept override { return state_; }
  void advance(const hal::Command& command, Duration dt) noexcept override {
    const double motor = command.expires > state_.sampled_at ? command.effort[0] : 0;
    t_ += seconds(dt);
    const double person = 500 * (0.02 * std::sin(6.28 * t_) - state_.x[0]) - 10 * state_.dx[0];
    state_.dq[0] = state_.dx[0] += (motor + person) / 0.1 * seconds(dt);
    state_.q[0] = state_.x[0] += state_.dx[0] * seconds(dt);
    state_.tau_out[0] = state_.f_out[0] = motor;
    state_.sampled_at += dt;
    ++state_.seq;
  }

 private:
  hal::DeviceCaps caps_;
  hal::State state_;
  double t_ = 0;
};

int main(int, char** arguments) {
  auto handle = std::make_unique<Handle>();
  const client::LiveSeatOptions wanted{.server = arguments[1] ? arguments[1] : "", .seat = "trainer"};
  const auto joined = client::LiveSeat::join(wanted, handle->caps());
  if (!joined) return std::fprintf(stderr, "%s\n", joined.error().c_str()), 1;
  client::LiveSeat& seat = **joined;
  std::printf("joined seat %s, %.0f ticks a second\n", seat.setup().seat.name.c_str(), seat.setup().tick_hz);
  hal::SimServo device{std::move(handle), {"handle", "1"}, 1ms};  // a thread that steps the handle and calls the seat
  if (!device.start(seat) || !device.enable()) return 1;
  while (seat.status().session != client::SessionState::kRunning && !seat.wait_until_closed(10ms)) continue;
  std::printf("the session runs\n");
  if (!seat.wait_until_closed(60s)) seat.leave();
  device.close();
  std::printf("the session is over after %.0f s\n", seat.status().session_time);
}
