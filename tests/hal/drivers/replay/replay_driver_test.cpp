#include "hal/drivers/replay/replay_driver.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "hal/backends/input_backends.h"
#include "hal/core/servo_core.h"
#include "tests/hal/drivers/manual_clock.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

constexpr const char* kLine = "t_s[s],px[m],py[m],pz[m]\n0,-0.01,0,0\n0.5,0,0,0\n1,0.01,0,0\n";

std::shared_ptr<const sim::RecordedMotion> line() {
  sim::MotionOptions options;
  options.scale = 1;
  auto motion = sim::RecordedMotion::parse(kLine, options, "line.csv");
  EXPECT_TRUE(motion) << (motion ? "" : motion.error());
  return std::make_shared<const sim::RecordedMotion>(std::move(*motion));
}

TEST(ReplayDriver, RestsUntilTheSeatJoinsThenPlaysInRealTime) {
  ManualClock clock;
  Patient patient;
  ReplayDriver driver{"line", line(), clock};
  ASSERT_TRUE(driver.bring_up(patient));
  State state;
  for (int i = 0; i < 100; ++i) {
    clock.at += 1ms;
    ASSERT_EQ(driver.exchange({}, state), Exchange::kFresh);
    EXPECT_NEAR(state.x[0], -0.01, 1e-12);
    EXPECT_EQ(state.dx[0], 0);
  }
  ServoCommand command;
  command.effort = {5, 5, 5};
  const Time begin = clock.at;
  for (int i = 0; i < 1500; ++i) {
    command.seq = static_cast<std::uint64_t>(i + 1);
    ASSERT_TRUE(driver.exchange(command, state));
    const double t = seconds(clock.at - begin);
    EXPECT_NEAR(state.x[0], t < 1 ? -0.01 + 0.02 * t : 0.01, 1e-9) << t;
    EXPECT_EQ(state.f_out, Vec3(Vec3::Zero())) << "it has no motors";
    clock.at += 1ms;
  }
  EXPECT_EQ(state.dx[0], 0) << "held at the end";
}

TEST(ReplayDriver, WorksUnderAServoCore) {
  ManualClock clock;
  Patient patient;
  struct Seat final : ServoClient {
    State seen;
    Command tick(const State& s) noexcept override {
      seen = s;
      return {.seq = s.seq, .expires = s.sampled_at + 5ms, .kind = CommandKind::kJointEffort, .effort = {1, 1, 1}};
    }
    void lost(Errc) noexcept override {}
  } seat;
  ServoCore core{std::make_unique<ReplayDriver>("line", line(), clock)};
  ASSERT_TRUE(core.bring_up(patient));
  ASSERT_EQ(core.phase(), Phase::kReady);
  ASSERT_TRUE(core.enable());
  const test::AllocGuard guard;
  for (int i = 0; i < 600; ++i) {
    clock.at += 1ms;
    ASSERT_TRUE(core.step(clock.at, seat));
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_NEAR(seat.seen.x[0], 0.002, 1e-3);
  EXPECT_EQ(core.phase(), Phase::kEnabled);
}

TEST(ReplayBackend, OpensAFileAndReportsItsMistakes) {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("tandem-replay-" + std::to_string(getpid()) + ".csv")).string();
  std::ofstream(file) << kLine;
  ReplayBackend backend;
  const auto opened = backend.open(*parse_device_spec("replay:" + file + ",scale=1,end=loop"));
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_NE(opened->driver->id().key.find(file), std::string::npos);
  const auto error = [&](const std::string& spec) {
    const auto wrong = backend.open(*parse_device_spec(spec));
    return wrong ? DeviceError{} : wrong.error();
  };
  EXPECT_EQ(error("replay").code, Errc::kUnsupported);
  EXPECT_NE(error("replay:/no/such.csv").message.find("/no/such.csv"), std::string::npos);
  EXPECT_NE(error("replay:" + file + ",end=stop").message.find("hold"), std::string::npos);
  EXPECT_NE(error("replay:" + file + ",loop=yes").message.find("end"), std::string::npos);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace tandem::hal
