// Parts of a simulation: faults over time, sensors with faults, a client's program, the server's process.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "hal/sim/sim_device.h"
#include "netsim/system/random_draws.h"
#include "netsim/system/sensor_faults.h"
#include "netsim/system/session_link_monitors.h"
#include "netsim/system/simulated_program.h"
#include "netsim/system/simulated_server.h"
#include "netsim/system/wake_order.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "tests/support/simulation_run.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;
using Kind = Fault::Kind;

constexpr Time at(Duration t) { return Time{} + t; }
constexpr AxisArray kOnes{1, 1, 1, 1, 1, 1, 1};

TEST(FaultSchedule, IsActiveFromItsBeginUntilBeforeItsEnd) {
  const FaultSchedule faults{{{.kind = Kind::kPause, .seat = "", .at = 1s, .length = 2s},
                              {.kind = Kind::kHot, .seat = "", .at = 5s, .length = 1s}}};
  EXPECT_FALSE(faults.active(Kind::kPause, at(1s - 1ns)));
  EXPECT_TRUE(faults.active(Kind::kPause, at(1s)));
  EXPECT_TRUE(faults.active(Kind::kPause, at(3s - 1ns)));
  EXPECT_FALSE(faults.active(Kind::kPause, at(3s)));
  EXPECT_FALSE(faults.active(Kind::kHot, at(2s)));
  EXPECT_TRUE(faults.ended(Kind::kPause, at(3s - 1ns), at(3s)));
  EXPECT_FALSE(faults.ended(Kind::kPause, at(3s), at(4s)));
  EXPECT_FALSE(faults.ended(Kind::kPause, at(2s), at(3s - 1ns)));
  EXPECT_TRUE(faults.contains(Kind::kHot));
  EXPECT_FALSE(faults.contains(Kind::kJunk));
  EXPECT_FALSE(faults.empty());
  EXPECT_TRUE(FaultSchedule{}.empty());
}

TEST(SensorFaults, FreezesAndInvalidatesReadings) {
  const FaultSchedule faults{{{.kind = Kind::kFrozen, .seat = "", .at = 1s, .length = 2s},
                              {.kind = Kind::kNotANumber, .seat = "", .at = 4s, .length = 1s},
                              {.kind = Kind::kHot, .seat = "", .at = 6s, .length = 1s}}};
  SensorFaults sensors{RandomKey{7}, 1ms};
  hal::State state;
  const auto q_at = [&](Duration t, double q) {
    state.q.fill(q);
    state.x[0] = q;
    const hal::State& read = sensors.read(at(t), faults, state, 1);
    return std::isfinite(read.q[0]) && std::isfinite(read.dq[0]) && std::isfinite(read.x[0]) ? read.q[0] : -1;
  };
  EXPECT_EQ(q_at(0s, 3), 3);
  EXPECT_EQ(q_at(1s, 4), 4) << "the reading at which it freezes";
  EXPECT_EQ(q_at(2s, 5), 4);
  EXPECT_EQ(q_at(3s, 6), 6);
  EXPECT_FALSE(sensors.invalid());
  EXPECT_EQ(q_at(4s, 7), -1);
  EXPECT_TRUE(sensors.invalid());
  EXPECT_EQ(q_at(5s, 8), 8);
  EXPECT_FALSE(sensors.invalid());
  EXPECT_FALSE(sensors.read(at(5s), faults, state, 1).heat);
  EXPECT_GT(sensors.read(at(6s), faults, state, 1).heat.value_or(0), 1);
}

TEST(SensorFaults, ReturnsTheDevicesOwnStateWithoutFaults) {
  SensorFaults sensors{RandomKey{7}, 1ms};
  const hal::State state;
  EXPECT_EQ(&sensors.read(at(1s), FaultSchedule{}, state, 3), &state);
}

/// A server, and the capabilities of a device for its seats.
struct Served {
  explicit Served(std::vector<Fault> faults = {})
      : config{.scene = test::set_position("free_motion"), .faults = std::move(faults)}, server{config} {
    EXPECT_EQ(server.start(at(1ms), kOnes), "");
    device =
        *hal::sim::SimDevice::make({config.scene.seats[0].device, config.scene.seats[0].hand, {}, nullptr, Time{}});
  }
  SimulationConfig config;
  SimulatedServer server;
  std::unique_ptr<hal::sim::SimDevice> device;
};

TEST(SimulatedProgram, JoinsOnceAndLosesItsSeatWhenItDies) {
  Served served;
  SimulatedProgram program{served.config.scene, 0, RandomKey{1}};
  const auto connect = [&](Duration t) {
    return program.connect(at(t), served.server.session(), served.device->caps(), nullptr);
  };
  EXPECT_FALSE(program.die()) << "it never ran";
  program.start();
  program.start();
  EXPECT_EQ(program.starts(), 1u);
  EXPECT_EQ(program.server_cid(), 0u);
  EXPECT_EQ(connect(1ms), "");
  ASSERT_NE(program.seat(), nullptr);
  EXPECT_NE(program.server_cid(), 0u);
  EXPECT_EQ(connect(2ms), "") << "it has its seat already";
  EXPECT_EQ(program.joins(), 1u);
  EXPECT_TRUE(program.die());
  EXPECT_EQ(program.seat(), nullptr);
  program.start();
  EXPECT_EQ(program.starts(), 2u);
  EXPECT_EQ(connect(3ms), "") << "the seat still belongs to the dead program; no error for a restarted one";
  EXPECT_EQ(program.joins(), 1u);
  EXPECT_EQ(program.gate_trips(), 0u);
}

TEST(SimulatedProgram, ReportsASeatThatIsTaken) {
  Served served;
  SimulatedProgram first{served.config.scene, 0, RandomKey{1}}, second{served.config.scene, 0, RandomKey{2}};
  for (SimulatedProgram* const program : {&first, &second}) program->start();
  EXPECT_EQ(first.connect(at(1ms), served.server.session(), served.device->caps(), nullptr), "");
  EXPECT_EQ(second.connect(at(1ms), served.server.session(), served.device->caps(), nullptr),
            "seat trainer: this seat is taken already");
}

TEST(SimulatedProgram, AppliesTheKeyPressesOfFaults) {
  Served served;
  SimulatedProgram program{served.config.scene, 0, RandomKey{1}};
  program.start();
  ASSERT_EQ(program.connect(at(1ms), served.server.session(), served.device->caps(), nullptr), "");
  const FaultSchedule faults{{{.kind = Kind::kStopHand, .seat = "", .at = 1s, .length = 1s}}};
  program.apply_stop_faults(at(0s), faults);
  EXPECT_FALSE(program.seat()->requests().locally_stopped());
  program.apply_stop_faults(at(1s), faults);
  EXPECT_TRUE(program.seat()->requests().locally_stopped());
  program.apply_stop_faults(at(2s), faults);
  EXPECT_FALSE(program.seat()->requests().locally_stopped());
}

TEST(SimulatedServer, RunsMissedTicksAtOnce) {
  Served served{{{.kind = Kind::kServerLate, .seat = "", .at = 2ms, .length = 3ms}}};
  SimulatedServer& server = served.server;
  EXPECT_EQ(server.due_ticks(at(1ms)), 1u);
  server.run(at(1ms));
  for (const Duration t : {2ms, 3ms, 4ms}) EXPECT_EQ(server.due_ticks(at(t)), 0u);
  EXPECT_EQ(server.due_ticks(at(5ms)), 4u) << "its own and three missed ones";
  server.run(at(5ms));
  EXPECT_EQ(server.due_ticks(at(6ms)), 1u);
}

TEST(SimulatedServer, MissesTicksWhileItsProcessorIsBusy) {
  Served served;
  served.config.tick_cost = [](Time, std::size_t sent) { return 1ms * static_cast<int>(sent); };
  ASSERT_EQ(served.server.due_ticks(at(1ms)), 1u);
  served.server.run(at(1ms));
  served.server.finish(at(1ms), 2);
  EXPECT_EQ(served.server.due_ticks(at(2ms)), 0u);
  EXPECT_EQ(served.server.due_ticks(at(3ms)), 2u);
}

TEST(SimulatedServer, RestartsFromItsCheckpointWithAnotherEpoch) {
  Served served{{{.kind = Kind::kServerRestart, .seat = "", .at = 2ms, .length = 3ms}}};
  SimulatedServer& server = served.server;
  const std::uint64_t epoch = server.session().epoch();
  EXPECT_EQ(server.apply_restarts(at(1ms)), "");
  EXPECT_TRUE(server.up());
  EXPECT_EQ(server.apply_restarts(at(2ms)), "");
  EXPECT_FALSE(server.up());
  EXPECT_EQ(server.session().epoch(), epoch) << "the state in which it died";
  EXPECT_EQ(server.apply_restarts(at(5ms)), "");
  EXPECT_TRUE(server.up());
  EXPECT_EQ(server.session().epoch(), epoch + 1);
}

TEST(SimulatedServer, UpdatesItsCheckpointTwiceASecondOrWhenParticipantsChange) {
  Served served;
  const auto join = [&](std::size_t seat) {
    SimulatedProgram program{served.config.scene, seat, RandomKey{seat}};
    program.start();
    EXPECT_EQ(program.connect(at(1ms), served.server.session(), served.device->caps(), nullptr), "");
  };
  const auto taken = [&](std::size_t seat, Duration t, bool changed) {
    served.server.update_checkpoint(at(t), changed);
    return served.server.checkpoint().seats[seat].taken;
  };
  join(0);
  EXPECT_FALSE(taken(0, 2ms, false));
  EXPECT_TRUE(taken(0, 3ms, true));
  join(1);
  EXPECT_FALSE(taken(1, 502ms, false));
  EXPECT_TRUE(taken(1, 503ms, false));
}

TEST(WakeOrder, SortsByTimeThenByNumber) {
  WakeOrder order{4};
  const auto sorted = [&order](std::array<Duration, 4> times) {
    return order.sort([&](std::size_t client) { return at(times[client]); });
  };
  using Order = std::vector<std::size_t>;
  EXPECT_EQ(sorted({1ms, 1ms, 1ms, 1ms}), (Order{0, 1, 2, 3}));
  EXPECT_EQ(sorted({4ms, 2ms, 3ms, 1ms}), (Order{3, 1, 2, 0}));
  EXPECT_EQ(sorted({2ms, 1ms, 2ms, 1ms}), (Order{1, 3, 0, 2}));
  EXPECT_EQ(sorted({1ms, 1ms, 1ms, 1ms}), (Order{0, 1, 2, 3})) << "an earlier order has no effect";
}

TEST(RandomDraws, AreReproducibleAndStayInTheirRanges) {
  RandomDraws one{RandomKey{7}}, same{RandomKey{7}}, other{RandomKey{8}};
  std::array<int, 3> chosen{};
  int differs = 0;
  for (int i = 0; i < 1000; ++i) {
    const double a = one.between(-2, 3), b = one.log_between(0.01, 100);
    EXPECT_TRUE(a >= -2 && a < 3 && b >= 0.01 * (1 - 1e-12) && b < 100 * (1 + 1e-12));
    EXPECT_EQ(same.between(-2, 3), a);
    EXPECT_EQ(same.log_between(0.01, 100), b);
    differs += other.between(-2, 3) != a ? 1 : 0;
    EXPECT_LT(one.below(5), 5u);
    same.below(5);
    EXPECT_TRUE(one.chance(1));
    EXPECT_FALSE(same.chance(0));
    ++chosen[one.choose(std::array{0.5, 0.0, 1.5})];
    same.choose(std::array{0.5, 0.0, 1.5});
  }
  EXPECT_GT(differs, 990);
  EXPECT_EQ(chosen[1], 0);
  EXPECT_NEAR(chosen[2], 750, 60);  // 4 sigma of a binomial distribution: 55
}

TEST(SessionLinkMonitors, SummariseEverySeatFromTheirStart) {
  Network network{1};
  SceneSpec scene;
  for (const char* name : {"a", "b"}) {
    network.add_link(LinkSpec{});
    scene.seats.emplace_back().name = name;
  }
  SessionLinkMonitors monitors;
  const std::array<std::byte, 8> bytes{};
  network.send(at(1ms), 0, Direction::kUp, bytes);
  EXPECT_FALSE(monitors.started());
  EXPECT_TRUE(monitors.qualities(scene).empty());
  monitors.start(at(2ms), network);
  EXPECT_TRUE(monitors.started());
  network.send(at(3ms), 0, Direction::kUp, bytes);
  network.send(at(3ms), 0, Direction::kDown, bytes);
  network.send(at(4ms), 0, Direction::kUp, bytes);
  const std::vector<NamedLink> links = monitors.qualities(scene);
  ASSERT_EQ(links.size(), 2u);
  EXPECT_EQ(links[0].name, "a");
  EXPECT_EQ(links[0].link.up.sent, 2u);
  EXPECT_EQ(links[0].link.down.sent, 1u);
  EXPECT_EQ(links[1].name, "b");
  EXPECT_EQ(links[1].link.up.sent, 0u);
}

TEST(Simulation, LeavesFreeSeatsFreeToTheEnd) {
  SimulationConfig setup;
  setup.scene = *parse_scene(find_shipped_scene("eight_seats")->text, "eight_seats.textproto");
  setup.free_seats = {"evaluator1", "evaluator7"};
  const auto simulation = *Simulation::make(setup);
  for (int tick = 0; tick < 1500; ++tick) ASSERT_TRUE(simulation->step());
  EXPECT_EQ(simulation->session().state(), wire::SessionState::kRunning);
  for (std::size_t i = 0; i < setup.scene.seats.size(); ++i)
    EXPECT_EQ(simulation->seat(i) == nullptr, setup.free_seats.contains(setup.scene.seats[i].name)) << i;
  setup.free_seats = {"trainee"};
  EXPECT_NE(Simulation::make(setup).error().find("seat trainee cannot stay free"), std::string::npos);
  setup.free_seats = {"nurse"};
  EXPECT_NE(Simulation::make(setup).error().find("a free seat nurse"), std::string::npos);
}

}  // namespace
}  // namespace tandem::netsim
