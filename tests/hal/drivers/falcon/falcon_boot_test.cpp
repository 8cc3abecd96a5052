#include "hal/drivers/falcon/falcon_boot.h"

#include <gtest/gtest.h>

#include "tests/common/base/counts.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"

namespace tandem::hal {
namespace {

using falcon::FalconFixture;
using falcon::some_firmware;
using falcon::Watcher;

TEST(FalconFirmware, IsCheckedBeforeItIsSent) {
  EXPECT_TRUE(check_firmware(some_firmware(), std::nullopt));
  EXPECT_TRUE(check_firmware(some_firmware(), std::string(64, 'a')));
  const auto other = check_firmware(some_firmware(), std::string(64, 'b'));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, Errc::kFirmware);
  EXPECT_NE(other.error().message.find("falcon.bin"), std::string::npos);
  EXPECT_NE(other.error().message.find("firmware.sha256"), std::string::npos);
  EXPECT_NE(check_firmware(some_firmware(6999), {}).error().message.find("7000 to 9000"), std::string::npos);
  EXPECT_FALSE(check_firmware(some_firmware(9001), {}));
  FalconFirmware text = some_firmware();
  for (auto& b : text.image) b = std::byte{'0'};
  EXPECT_NE(check_firmware(text, {}).error().message.find("text"), std::string::npos);
  for (auto& b : text.image) b = std::byte{0};
  EXPECT_NE(check_firmware(text, {}).error().message.find("one byte"), std::string::npos);
}

TEST(FalconBoot, KeepsRunningFirmware) {
  FalconFixture bench(falcon::ready_model(), falcon::calibrated(), /*with_firmware=*/false);
  Watcher watcher;
  const auto up = bench.driver.bring_up(watcher);
  ASSERT_TRUE(up) << up.error().message;
  EXPECT_EQ(bench.driver.boot_attempts(), 0);
  EXPECT_EQ(bench.model.loads(), 0u);
}

TEST(FalconBoot, LoadsTheUsersImageWithEveryByteEchoed) {
  FalconFixture bench;
  Watcher watcher;
  const auto up = bench.driver.bring_up(watcher);
  ASSERT_TRUE(up) << up.error().message;
  EXPECT_EQ(bench.driver.boot_attempts(), 1);
  EXPECT_TRUE(bench.model.running());
  EXPECT_EQ(bench.model.image(), some_firmware().image);
  EXPECT_EQ(watcher.steps.back().second, 1.0);
  EXPECT_EQ(bench.model.order(), FalconCommand{}) << "bring-up leaves zero effort";
  std::printf("[ measured ] firmware loaded after %.2f s of virtual time\n", seconds(bench.clock.now() - Time{}) - 1);
}

TEST(FalconBoot, NamesTheRemedyForAMissingFile) {
  FalconFixture bench({}, falcon::calibrated(), /*with_firmware=*/false);
  Watcher watcher;
  const auto up = bench.driver.bring_up(watcher);
  ASSERT_FALSE(up);
  EXPECT_EQ(up.error().code, Errc::kFirmware);
  EXPECT_NE(up.error().message.find("firmware=FILE"), std::string::npos);
}

struct Trouble {
  const char* name;
  void (*make)(emulation::FalconFaults&);
  int attempts;
};

class FalconBootTrouble : public testing::TestWithParam<Trouble> {};

TEST_P(FalconBootTrouble, EndsInASuccessfulBoot) {
  FalconFixture bench;
  GetParam().make(bench.model.faults);
  Watcher watcher;
  const auto up = bench.driver.bring_up(watcher);
  ASSERT_TRUE(up) << up.error().message;
  EXPECT_EQ(bench.driver.boot_attempts(), GetParam().attempts);
  EXPECT_EQ(bench.model.image(), some_firmware().image);
  bench.begin();
  EXPECT_EQ(*bench.tick(), Exchange::kFresh);
}

INSTANTIATE_TEST_SUITE_P(
    Each, FalconBootTrouble,
    testing::Values(Trouble{"none", [](emulation::FalconFaults&) {}, 1},
                    Trouble{"leading_zero", [](emulation::FalconFaults& f) { f.leading_zero = true; }, 1},
                    Trouble{"leading_13", [](emulation::FalconFaults& f) { f.leading_13 = true; }, 1},
                    Trouble{"never_cts", [](emulation::FalconFaults& f) { f.never_cts = true; }, 1},
                    Trouble{"needs_cts", [](emulation::FalconFaults& f) { f.needs_cts = true; }, 1},
                    Trouble{"deaf_twice", [](emulation::FalconFaults& f) { f.deaf_greetings = 2; }, 1},
                    Trouble{"deaf_for_two_attempts", [](emulation::FalconFaults& f) { f.deaf_greetings = 6; }, 3},
                    Trouble{"wrong_echo", [](emulation::FalconFaults& f) { f.wrong_echoes = 1; }, 2},
                    Trouble{"dead_loads", [](emulation::FalconFaults& f) { f.dead_loads = 5; }, 6},
                    Trouble{"eleven_bad_attempts", [](emulation::FalconFaults& f) { f.dead_loads = 11; }, 12}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(FalconBoot, GivesUpAfterTwelveAttemptsAndReportsTheReason) {
  struct Case {
    void (*make)(emulation::FalconFaults&);
    const char* words;
  };
  for (const Case& c : {Case{[](emulation::FalconFaults& f) { f.deaf_greetings = 1000; }, "greeting"},
                        Case{[](emulation::FalconFaults& f) { f.wrong_echoes = 1000; }, "other bytes"},
                        Case{[](emulation::FalconFaults& f) { f.dead_loads = 1000; }, "does not answer"},
                        Case{[](emulation::FalconFaults& f) { f.stall_control = 1000; }, "could not be reset"},
                        Case{[](emulation::FalconFaults& f) { f.stall_out = 100000; }, "writing"}}) {
    FalconFixture bench;
    c.make(bench.model.faults);
    Watcher watcher;
    const auto up = bench.driver.bring_up(watcher);
    ASSERT_FALSE(up);
    EXPECT_EQ(up.error().code, Errc::kFirmware);
    EXPECT_EQ(bench.driver.boot_attempts(), kBootAttempts);
    EXPECT_NE(up.error().message.find(c.words), std::string::npos) << up.error().message;
  }
  static_assert(kBootAttempts >= 10);
}

TEST(FalconBoot, ClearsAStallAndContinues) {
  for (int which = 0; which < 3; ++which) {
    FalconFixture bench;
    (which == 0   ? bench.model.faults.stall_in
     : which == 1 ? bench.model.faults.stall_out
                  : bench.model.faults.stall_control) = 1;
    Watcher watcher;
    const auto up = bench.driver.bring_up(watcher);
    ASSERT_TRUE(up) << which << up.error().message;
  }
}

/// Pipe that forwards everything and unplugs the device before transfer number `at`.
struct CuttingPipe final : UsbPipe {
  CuttingPipe(UsbPipe& inner, emulation::FalconModel& m, long transfer) : pipe(inner), model(m), left(transfer) {}
  void count() {
    ++transfers;
    if (left-- == 0) model.unplug();
  }
  std::expected<void, Errc> control(std::uint8_t r, std::uint16_t v, std::uint16_t i) noexcept override {
    count();
    return pipe.control(r, v, i);
  }
  Moved write(std::span<const std::byte> b, Duration t) noexcept override {
    count();
    return pipe.write(b, t);
  }
  Moved read(std::span<std::byte> b, Duration t) noexcept override {
    count();
    return pipe.read(b, t);
  }
  std::expected<void, Errc> clear_halt() noexcept override { return pipe.clear_halt(); }
  UsbPipe& pipe;
  emulation::FalconModel& model;
  long left, transfers = 0;
};

TEST(FalconBoot, EndsAtOnceWhenUnpluggedInAnyPhase) {
  long total = 0;
  const auto run = [&](long at) {
    emulation::FalconModel model;
    emulation::ModelClock clock(model);
    emulation::UsbModelPipe inner(model, clock, kFalconOut, kFalconIn);
    CuttingPipe pipe(inner, model, at);
    auto driver = *FalconDriver::make({"falcon", "1"}, pipe, clock, {falcon::calibrated(), some_firmware()});
    Watcher watcher;
    const auto up = driver.bring_up(watcher);
    if (at < 0) {
      total = pipe.transfers;
      ASSERT_TRUE(up);
      return;
    }
    ASSERT_FALSE(up) << at;
    ASSERT_EQ(up.error().code, Errc::kUnplugged) << at << ": " << up.error().message;
    ASSERT_LE(pipe.transfers, at + 3) << "continued to send without a device";
    driver.send_zeros();
  };
  run(-1);
  const long step = std::max<long>(1, total / static_cast<long>(test::draws(80, 1500, 15000)));
  for (long at = 0; at < total; at += step) run(at);
}

TEST(FalconBoot, CanBeCancelledAnywhere) {
  for (int looks = 1; looks < 100; looks += 3) {
    FalconFixture bench;
    bench.model.faults.wrong_echoes = 1;
    Watcher watcher;
    watcher.looks_left = looks;
    const auto up = bench.driver.bring_up(watcher);
    ASSERT_FALSE(up) << looks;
    EXPECT_EQ(up.error().code, Errc::kBadState);
  }
}

}  // namespace
}  // namespace tandem::hal
