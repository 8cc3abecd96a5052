// Tier T4: the checks of `tandem-client doctor` with a real device, as a test. Zero force only, so no hand has to hold
// it.
//   TANDEM_HARDWARE          device specification of --device; several are separated by ;
//   TANDEM_HARDWARE_UNPLUG   yes: asks the user to unplug the device at the end
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "client/app/hardware_device.h"
#include "client/diagnostics/device_diagnostics.h"
#include "common/io/clock.h"
#include "common/io/signals.h"
#include "hal/backends/backend.h"
#include "hal/io/periodic_timer.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using client::DeviceDiagnostics;
using client::HardwareDevice;

constexpr Duration kWatched = 10s, kUnplugPatience = 30s;

std::vector<std::string> devices() {
  std::vector<std::string> all;
  const char* words = std::getenv("TANDEM_HARDWARE");
  std::istringstream text(words == nullptr ? "" : words);
  for (std::string one; std::getline(text, one, ';');)
    if (!one.empty()) all.push_back(one);
  return all;
}

/// Client that never commands a force and records the readings.
class Onlooker final : public hal::ServoClient {
 public:
  explicit Onlooker(const hal::DeviceCaps& caps) : examination_(caps) {}
  hal::Command tick(const hal::State& state) noexcept override {
    examination_.update(state);
    pushed_ = pushed_ || state.f_out.norm() > 0 || std::ranges::any_of(state.tau_out, [](double e) { return e != 0; });
    return {};
  }
  void lost(hal::Errc) noexcept override { lost_ = true; }
  [[nodiscard]] bool was_lost() const noexcept { return lost_; }
  /// Valid after the device was closed.
  [[nodiscard]] bool pushed() const noexcept { return pushed_; }
  [[nodiscard]] const DeviceDiagnostics& examination() const noexcept { return examination_; }

 private:
  DeviceDiagnostics examination_;
  bool pushed_ = false;
  std::atomic<bool> lost_{false};
};

/// Fixture; without a device every test is skipped.
struct HardwareTest : testing::Test {
  void SetUp() override {
    if (devices().empty())
      GTEST_SKIP()
          << "no device is named; ./test --hardware SPEC, a device specification as listed by `tandem-client doctor`";
  }
  static const io::Fd& signals() {
    static const io::Fd file = io::make_signalfd();
    return file;
  }
  /// Brings a device up, homes it with the user's help and observes it. @return whether it was lost meanwhile
  static bool watch(const std::string& words, Duration time, bool until_lost) {
    io::StatusLine line{false};
    auto held = HardwareDevice::open(words, signals().get(), line, {});
    if (!held) {
      ADD_FAILURE() << held.error().reason;
      return false;
    }
    hal::Device& device = (*held)->device();
    const hal::DeviceCaps caps = device.caps();
    Onlooker onlooker{caps};
    (*held)->observe(onlooker);
    const Time begin = io::monotonic_now();
    hal::MonotonicClock clock;
    while (io::monotonic_now() - begin < time && !onlooker.was_lost()) clock.wait_until(io::monotonic_now() + 20ms);
    const double watched = seconds(io::monotonic_now() - begin);
    const hal::Phase phase = device.phase();
    const hal::DeviceStats stats = device.stats();
    device.close();
    for (const auto& finding : onlooker.examination().findings(stats, watched))
      std::printf("  %s\n", finding.text.c_str());
    std::printf(
        "[ measured ] %s: %.1f readings a second for %.1f s, round trip p50 %.3f p99 %.3f max %.3f ms, %llu late, %llu "
        "missed, "
        "%llu unanswered, %llu resyncs\n",
        (*held)->note().c_str(), static_cast<double>(onlooker.examination().readings()) / watched, watched,
        1e3 * stats.round_trip_p50_s, 1e3 * stats.round_trip_p99_s, 1e3 * stats.round_trip_max_s,
        static_cast<unsigned long long>(stats.late), static_cast<unsigned long long>(stats.missed),
        static_cast<unsigned long long>(stats.unanswered), static_cast<unsigned long long>(stats.resyncs));
    EXPECT_FALSE(onlooker.pushed()) << "a force was given without a command";
    if (until_lost) return onlooker.was_lost();
    EXPECT_FALSE(onlooker.was_lost());
    EXPECT_EQ(phase, hal::Phase::kReady);
    EXPECT_GT(onlooker.examination().readings() + (caps.input == hal::InputKind::kRate ? stats.ticks : 0), 0u);
    if (caps.input == hal::InputKind::kPose &&
        time >= kWatched) {  // in a shorter time, one pause of the machine would be half of it
      EXPECT_GE(static_cast<double>(onlooker.examination().readings()) / watched, 0.97 * caps.nominal_hz);
    }
    EXPECT_LE(stats.unanswered, stats.ticks / 100);
    return onlooker.was_lost();
  }
};

TEST_F(HardwareTest, AcceptsTheDeviceSpecAndItsFiles) {
  for (const std::string& words : devices())
    for (const std::string& mistake : HardwareDevice::spec_errors(words)) ADD_FAILURE() << mistake;
}

TEST_F(HardwareTest, IsListedAndMayBeOpened) {
  for (const std::string& words : devices()) {
    SCOPED_TRACE(words);
    const auto choice = hal::parse_device_spec(words);
    ASSERT_TRUE(choice) << choice.error().message;
    const auto backend = hal::find_backend(choice->backend);
    ASSERT_TRUE(backend) << backend.error().message;
    std::printf("  %s\n", (*backend)->library().c_str());
    if (choice->backend == "replay") continue;  // a file, to try this test without a device
    const auto listed = (*backend)->list();
    ASSERT_TRUE(listed) << listed.error().message;
    EXPECT_FALSE(listed->empty()) << "none is attached";
    for (const hal::FoundDevice& found : *listed) {
      std::printf("  %s: %s\n", found.spec.c_str(), found.description.c_str());
      EXPECT_EQ(found.problem, "");
    }
  }
}

TEST_F(HardwareTest, KeepsItsRateForTenSecondsWithoutForce) {
  for (const std::string& words : devices()) {
    SCOPED_TRACE(words);
    watch(words, kWatched, false);
  }
}

TEST_F(HardwareTest, OpensAgainAfterItWasClosed) {
  for (const std::string& words : devices()) {
    SCOPED_TRACE(words);
    for (int round = 0; round < 3; ++round) watch(words, 1s, false);
  }
}

TEST_F(HardwareTest, DetectsUnplugging) {
  const char* wanted = std::getenv("TANDEM_HARDWARE_UNPLUG");
  if (wanted == nullptr || std::string_view(wanted) != "yes")
    GTEST_SKIP() << "needs a person who pulls the plug; TANDEM_HARDWARE_UNPLUG=yes";
  for (const std::string& words : devices()) {
    SCOPED_TRACE(words);
    std::printf("pull the plug of %s within %.0f s\n", words.c_str(), seconds(kUnplugPatience));
    std::fflush(stdout);
    EXPECT_TRUE(watch(words, kUnplugPatience, true)) << "it was not unplugged, or that was not detected";
  }
}

}  // namespace
}  // namespace tandem::test
