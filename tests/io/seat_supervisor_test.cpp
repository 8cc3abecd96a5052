// A SeatSupervisor with a real server, and with a test in place of the servo thread.
#include "client/app/seat_supervisor.h"

#include <gtest/gtest.h>

#include <atomic>

#include "client/app/seat_observer.h"
#include "common/io/clock.h"
#include "hal/io/open_sim_device.h"
#include "tests/io/service_join_fixture.h"

namespace tandem::client {
namespace {

/// Leaves the seat when the test says so.
struct LeaveWhenOver final : SeatObserver {
  void on_joined(const SeatSetup&) override {}
  void on_key(const std::string&) override {}
  std::vector<std::string> messages(double, const ClientStatus&) override { return {}; }
  std::string leave_reason() override { return over ? "the test is over" : ""; }
  std::atomic<bool> over{false};
};

TEST_F(ServiceJoin, KeepsANewConnectionWhileTheStatusIsOfTheOldOne) {
  auto a = member("desk-a");
  const auto b = member("desk-b");
  know(*a);
  a->serve(5);
  a->on_thread([&] { a->directory.addresses = {a->at(), b->at()}; });
  point(*b, SessionLocator::Coming{});
  LeaveWhenOver observer;
  SeatOptions plan;
  plan.join = options({a.get()}, 5s);
  plan.observer = &observer;
  const auto joined = join_seat(plan.join);
  ASSERT_TRUE(joined) << joined.error().reason;
  const SeatSetup& setup = joined->setup;
  io::UdpSocket socket = io::connect_udp(joined->udp).value();
  io::UdpSocket kept = io::duplicate(socket);
  Seat seat{setup, plan.join.caps, joined->link};
  SeatRunner runner{std::move(socket), seat, nullptr, {}, nullptr};
  KeyboardControls keyboard{runner.commands(), setup, nullptr};
  const hal::LiveSim live =
      hal::make_live(hal::open_sim_device("sim", setup.seat.device, setup.seat.hand, setup.seat.environment).value(),
                     from_seconds(1 / setup.tick_hz));
  io::StatusLine line{true};
  SeatSupervisor supervisor{{plan, plan.join, *joined, seat, runner, keyboard, *live.device, nullptr, -1, line},
                            std::move(kept)};
  std::thread person([&] { EXPECT_EQ(supervisor.run(), ExitReason::kLeft); });
  const auto tick = [&] {
    hal::State state;
    state.J.leftCols<3>().setIdentity();
    static_cast<void>(runner.tick(state));
    std::this_thread::sleep_for(1ms);
  };
  while (!a->hears_trainee()) tick();
  a->silence();
  while (runner.status().silence_s < 0.6) tick();
  a.reset();
  b->serve(9, secret_of(*joined));
  while (b->count(server::ControlEvent::kWelcomed) == 0) std::this_thread::sleep_for(10ms);
  // Twice the time after which a silent server is asked again.
  for (const Time begin = io::monotonic_now(); io::monotonic_now() - begin < 3s;) std::this_thread::sleep_for(20ms);
  EXPECT_EQ(b->count(server::ControlEvent::kWelcomed), 1U) << "a second one invalidates the first";
  observer.over = true;
  while (!runner.status().closed) tick();
  EXPECT_EQ(runner.status().reconnects, 1U);
  person.join();
}

}  // namespace
}  // namespace tandem::client
