#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "hal/core/servo_core.h"
#include "tests/hal/walkthrough/cube_driver.h"
#include "tests/support/alloc_guard.h"

// The device of hal/README.md, "A new device": the README contains its driver word for word, and it runs here.
namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

/// Model of the cube: 0.1 kg on three rails with some friction; it answers each report with one.
struct Cube final : HidPipe, Clock {
  std::array<double, 3> x{}, v{}, force{};
  bool zeroed = false, unplugged = false, silent = false, waiting = false;
  std::size_t reports = 0;
  Time t{1s};

  Moved write(std::span<const std::byte> report) noexcept override {
    if (unplugged) return std::unexpected(Errc::kUnplugged);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto low = std::to_integer<unsigned>(report[2 * i]), high = std::to_integer<unsigned>(report[2 * i + 1]);
      force[i] = static_cast<std::int16_t>(low | high << 8) / 1000.0;
    }
    if (report[6] == std::byte{1}) zeroed = true;
    waiting = true;
    ++reports;
    return report.size();
  }
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override {
    if (unplugged) return std::unexpected(Errc::kUnplugged);
    if (silent || !waiting) {
      t += timeout;
      return 0;
    }
    waiting = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto counts = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(x[i] / 1e-5)));
      into[2 * i] = static_cast<std::byte>(counts & 0xff);
      into[2 * i + 1] = static_cast<std::byte>(counts >> 8);
    }
    into[6] = std::byte{0};
    into[7] = std::byte{zeroed};
    return 8;
  }
  Time now() noexcept override { return t; }
  void wait_until(Time at) noexcept override { t = at; }
  void advance() {
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] += (force[i] - 0.5 * v[i]) / 0.1 * 1e-3;
      x[i] += v[i] * 1e-3;
    }
    t += 1ms;
  }
};

struct Pushes final : ServoClient {
  AxisArray effort{};
  Cube& cube;
  explicit Pushes(Cube& c) : cube(c) {}
  Command tick(const State&) noexcept override { return {1, cube.t + 5ms, CommandKind::kJointEffort, effort}; }
  void lost(Errc) noexcept override {}
};

struct Nobody final : BringUp {
  void progress(std::string_view, double) override {}
  bool cancelled() const noexcept override { return false; }
};

TEST(Walkthrough, HomesPushesAndReleasesWithTheReadmeDriver) {
  Cube cube;
  Pushes client{cube};
  ServoCore core{std::make_unique<CubeDriver>(DeviceId{"cube", "1"}, cube, cube)};
  Nobody nobody;
  ASSERT_TRUE(core.bring_up(nobody));
  const auto run = [&](int ms) {
    for (int i = 0; i < ms; ++i) {
      cube.advance();
      core.step(cube.t, client);
    }
  };
  EXPECT_EQ(core.phase(), Phase::kUnhomed);
  run(2);
  EXPECT_EQ(core.phase(), Phase::kReady);
  ASSERT_TRUE(core.enable());
  client.effort = {0.2, 0, -0.1};
  run(600);
  EXPECT_NEAR(core.state().f_out[0], 0.2, 1e-9);
  EXPECT_GT(core.state().x[0], 0.05);
  EXPECT_LT(core.state().x[2], -0.025);
  EXPECT_NEAR(core.state().dx[0], cube.v[0], 0.02);
  client.effort = {100, 0, 0};  // above the peak of 4 N: limited by the guard, not by the driver
  run(2);
  EXPECT_NEAR(cube.force[0], 4.0, 1e-6);
  cube.silent = true;
  run(12);
  EXPECT_EQ(core.phase(), Phase::kFault);
  cube.silent = false;
  run(2);
  EXPECT_EQ(cube.force[0], 0.0);
  cube.unplugged = true;
  EXPECT_FALSE(core.step(cube.t, client));
  EXPECT_EQ(core.phase(), Phase::kLost);
}

TEST(Walkthrough, ExchangesWithoutHeap) {
  Cube cube;
  CubeDriver driver{{"cube", "1"}, cube, cube};
  State state;
  const test::AllocGuard guard;
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(driver.exchange({}, state));
  EXPECT_EQ(guard.count(), 0U);
}

TEST(Walkthrough, MatchesTheDriverInTheReadme) {
  const auto text_of = [](const std::string& name) {
    std::ifstream in(std::string(TANDEM_SOURCE_DIR) + "/" + name);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  };
  const std::string driver = text_of("tests/hal/walkthrough/cube_driver.h");
  ASSERT_FALSE(driver.empty());
  EXPECT_LT(std::ranges::count(driver, '\n'), 150);
  EXPECT_NE(text_of("hal/README.md").find(driver), std::string::npos)
      << "hal/README.md shows another driver than the one tested here";
}

}  // namespace
}  // namespace tandem::hal
