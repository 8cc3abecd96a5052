// The SpaceMouse driver over the real hidapi, on its device model: wired units (two alternating reports) and wireless
// ones (all axes in one report).
#include <gtest/gtest.h>

#include "common/base/rng.h"
#include "hal/drivers/spacemouse/products.h"
#include "hal/drivers/spacemouse/spacemouse_driver.h"
#include "hal/io/hid_pipe.h"
#include "hal/io/periodic_timer.h"
#include "tests/common/base/counts.h"
#include "tests/hal/emulation/devices/hid_model_pipe.h"
#include "tests/hal/emulation/devices/spacemouse_model.h"
#include "tests/hal/emulation/echo_model.h"
#include "tests/hal/emulation/testbed.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using hal::Errc;
using hal::emulation::SpaceMouseModel;
using hal::emulation::SpaceMouseModelParams;

constexpr double kSpeed = 0.1, kTurn = 0.5;  // at full deflection, 350 counts [m/s, rad/s]

SpaceMouseModelParams with_cable() { return {}; }
SpaceMouseModelParams wireless() {
  SpaceMouseModelParams params;
  params.combined = true;
  params.vendor = 0x256F;
  params.product = 0xC62F;
  params.name = "SpaceMouse Wireless Receiver";
  return params;
}

/// Opens any plugged-in device that reports the SpaceMouse usage.
hal::Result<std::unique_ptr<hal::HidrawPipe>> open_puck() {
  for (const hal::AttachedDevice& device : hal::list_hidraw()) {
    for (const hal::HidUsage& usage : device.usages) {
      if (hal::spacemouse::is_spacemouse(device.ids.vendor, device.ids.product, usage.page, usage.usage))
        return hal::HidrawPipe::open(device);
    }
  }
  return std::unexpected(hal::DeviceError{Errc::kNotFound, "no puck"});
}

/// A SpaceMouse model and the driver that reads it.
struct Puck {
  explicit Puck(Testbed& bed_, hal::emulation::EmulatedHidDevice& model) : bed(bed_), node(model) {
    bed.plug(node, model, "1-2");
  }
  ~Puck() { bed.remove("1-2"); }
  hal::Result<> begin() {
    auto opened = open_puck();
    if (!opened) return std::unexpected(opened.error());
    pipe = std::move(*opened);
    driver = std::make_unique<hal::spacemouse::SpaceMouseDriver>(hal::DeviceId{"spacemouse", "1-2"}, *pipe, clock);
    QuietBringUp watcher;
    return driver->bring_up(watcher);
  }
  std::optional<Errc> tick(std::uint8_t leds = 1) {
    const auto result = driver->exchange({.seq = ++seq, .leds = leds}, state);
    clock.wait_until(clock.now() + 1ms);
    return error_of(result);
  }
  /// Ticks until the condition holds, or until it clearly does not.
  template <class Is>
  bool until(Is&& is) {
    for (int i = 0; i < 3000; ++i) {
      if (tick()) return false;
      if (is()) return true;
    }
    return false;
  }
  Testbed& bed;
  HidrawNode node;
  hal::MonotonicClock clock;
  std::unique_ptr<hal::HidrawPipe> pipe;
  std::unique_ptr<hal::spacemouse::SpaceMouseDriver> driver;
  hal::State state;
  std::uint64_t seq = 0;
};

class EverySpaceMouse : public testing::TestWithParam<SpaceMouseModelParams> {};
INSTANTIATE_TEST_SUITE_P(SpaceMouse, EverySpaceMouse, testing::Values(with_cable(), wireless()),
                         [](const auto& of) { return of.param.combined ? "Wireless" : "WithCable"; });

TEST_P(EverySpaceMouse, MovesRotatesRestsAndLights) {
  Testbed bed;
  SpaceMouseModel model(GetParam());
  Puck puck(bed, model);
  ASSERT_TRUE(puck.begin());
  EXPECT_TRUE(puck.node.with_model([&] { return model.light(); }));
  puck.node.with_model([&] { model.deflect({350, 0, -175, 0, 350, 0}); });
  // HAL: x as the maker's, y and z opposite.
  EXPECT_TRUE(puck.until([&] {
    return puck.state.dx == hal::Vec3(kSpeed, 0, kSpeed / 2) && puck.state.dq[4] == -kTurn;
  })) << puck.state.dx.transpose()
      << ", " << puck.state.dq[4];
  puck.node.with_model([&] { model.press(5), model.tell_battery(42, false); });
  EXPECT_TRUE(puck.until([&] { return puck.state.buttons == 5 && puck.driver->battery_percent() == 42; }));
  puck.node.with_model([&] { model.deflect({}), model.press(0); });
  EXPECT_TRUE(puck.until(
      [&] { return puck.state.dx == hal::Vec3::Zero() && puck.state.dq[4] == 0 && puck.state.buttons == 0; }));
  EXPECT_TRUE(puck.until([&] { return puck.state.stale; })) << "a puck at rest falls silent";
  EXPECT_EQ(puck.state.dx, hal::Vec3::Zero());
  puck.driver->send_zeros();
  EXPECT_FALSE(puck.node.with_model([&] { return model.light(); }));
}

TEST_P(EverySpaceMouse, ComesToRestIfItFailsInMotion) {
  Testbed bed;
  SpaceMouseModel model(GetParam());
  Puck puck(bed, model);
  ASSERT_TRUE(puck.begin());
  puck.node.with_model([&] { model.deflect({0, 350, 0, 0, 0, 0}); });
  ASSERT_TRUE(puck.until([&] { return puck.state.dx[1] == -kSpeed; }));
  puck.node.with_model([&] { model.faults.silent = true; });
  EXPECT_TRUE(puck.until([&] { return puck.state.dx == hal::Vec3::Zero() && puck.state.stale; }));
}

TEST_P(EverySpaceMouse, ReportsDeniedPermissionAndABusyDevice) {
  Testbed bed;
  SpaceMouseModel model(GetParam());
  Puck puck(bed, model);
  {
    bed.set_mode("/dev/hidraw0", 0);
    const WithoutOverride nobody;
    const auto denied = open_puck();
    ASSERT_FALSE(denied);
    EXPECT_EQ(denied.error().code, Errc::kPermission);
    const std::string ids = GetParam().combined ? "256F:C62F" : "046D:C626";
    EXPECT_NE(denied.error().message.find(R"(SUBSYSTEM=="hidraw", KERNELS=="*:)" + ids +
                                          R"(.*", MODE="0660", TAG+="uaccess")"),
              std::string::npos)
        << denied.error().message;
    bed.set_mode("/dev/hidraw0", 0600);
  }
  ASSERT_TRUE(puck.begin());
  const auto second = open_puck();
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);
  puck.pipe.reset();
  EXPECT_TRUE(open_puck());
}

TEST_P(EverySpaceMouse, ReportsUnpluggingAtOnceAndRestsAfterReplug) {
  Testbed bed;
  SpaceMouseModel model(GetParam());
  {
    Puck puck(bed, model);
    ASSERT_TRUE(puck.begin());
    puck.node.with_model([&] { model.deflect({350, 0, 0, 0, 0, 0}); });
    ASSERT_TRUE(puck.until([&] { return puck.state.dx[0] == kSpeed; }));
    puck.node.unplug();
    EXPECT_EQ(puck.tick(), Errc::kUnplugged);
    EXPECT_EQ(puck.tick(), Errc::kUnplugged);
    puck.driver->send_zeros();
  }
  EXPECT_TRUE(hal::list_hidraw().empty());
  model.deflect({});
  model.plug_in();
  Puck again(bed, model);
  ASSERT_TRUE(again.begin());
  EXPECT_TRUE(again.node.with_model([&] { return model.light(); }));
  EXPECT_EQ(again.tick(), std::nullopt);
  EXPECT_EQ(again.state.dx, hal::Vec3::Zero());
  again.node.with_model([&] { model.deflect({0, 0, 350, 0, 0, 0}); });
  EXPECT_TRUE(again.until([&] { return again.state.dx[2] == -kSpeed; }));
}

TEST_P(EverySpaceMouse, EndsTheStartIfUnpluggedWhileTheLightIsSet) {
  Testbed bed;
  SpaceMouseModel model(GetParam());
  Puck puck(bed, model);
  puck.node.unplug_at(1);
  const auto up = puck.begin();
  ASSERT_FALSE(up);
  EXPECT_EQ(up.error().code, Errc::kUnplugged);
}

/// A SpaceMouse with random reports in between: any id, any length, any bytes.
class Rubbish final : public hal::emulation::EmulatedHidDevice {
 public:
  Rubbish(SpaceMouseModel& model, std::uint64_t seed) : model_(model), random_(seed) {}
  hal::emulation::TransferResult report_in(std::span<std::byte> into) noexcept override {
    if (left > 0 && random_.below(2) == 0) {
      --left;
      const std::size_t size = 1 + random_.below(60);
      for (std::size_t i = 0; i < size; ++i) into[i] = static_cast<std::byte>(random_.below(256));
      if (random_.below(2) == 0) into[0] = static_cast<std::byte>(1 + random_.below(4));
      return size;
    }
    return model_.report_in(into);
  }
  void advance(Duration dt) noexcept override { model_.advance(dt); }
  void unplug() noexcept override { model_.unplug(); }
  void plug_in() noexcept override { model_.plug_in(); }
  [[nodiscard]] bool plugged_in() const noexcept override { return model_.plugged_in(); }
  [[nodiscard]] std::uint16_t vendor_id() const noexcept override { return model_.vendor_id(); }
  [[nodiscard]] std::uint16_t product_id() const noexcept override { return model_.product_id(); }
  [[nodiscard]] std::string_view manufacturer() const noexcept override { return model_.manufacturer(); }
  [[nodiscard]] std::string_view product() const noexcept override { return model_.product(); }
  [[nodiscard]] std::string_view serial() const noexcept override { return model_.serial(); }
  [[nodiscard]] std::span<const std::byte> report_descriptor() const noexcept override {
    return model_.report_descriptor();
  }
  hal::emulation::TransferResult report_out(std::span<const std::byte> report) noexcept override {
    return model_.report_out(report);
  }
  hal::emulation::TransferResult feature_set(std::span<const std::byte> report) noexcept override {
    return model_.feature_set(report);
  }
  hal::emulation::TransferResult feature_get(std::span<std::byte> into) noexcept override {
    return model_.feature_get(into);
  }

  unsigned left = 0;

 private:
  SpaceMouseModel& model_;
  RandomStream random_;
};

TEST_P(EverySpaceMouse, BoundsTheVelocityForGarbageAndRecovers) {
  const auto reports = static_cast<unsigned>(draws(20'000, 200'000, 2'000'000));
  std::printf("[ reports  ] %u of rubbish\n", reports);
  Testbed bed;
  SpaceMouseModel model(GetParam());
  Rubbish between(model, 11);
  Puck puck(bed, between);
  ASSERT_TRUE(puck.begin());
  puck.node.with_model([&] { between.left = reports; });
  for (unsigned left = reports; left > 0;) {
    ASSERT_EQ(error_of(puck.driver->exchange({.seq = 1, .leds = 1}, puck.state)), std::nullopt);
    ASSERT_TRUE(puck.state.dx.allFinite());
    ASSERT_LE(puck.state.dx.cwiseAbs().maxCoeff(), kSpeed);
    for (std::size_t i = 3; i < 6; ++i) ASSERT_LE(std::abs(puck.state.dq[i]), kTurn);
    left = puck.node.with_model([&] { return between.left; });
  }
  EXPECT_GT(puck.driver->odd_reports(), 0u);
  puck.node.with_model([&] { model.deflect({-350, 0, 0, 0, 0, 0}); });
  EXPECT_TRUE(puck.until([&] { return puck.state.dx == hal::Vec3(-kSpeed, 0, 0); }));
}

}  // namespace
}  // namespace tandem::test
