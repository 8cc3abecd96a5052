#include "hal/io/device_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

/// Driver of one axis without a force, ready at once.
class StillDriver final : public Driver {
 public:
  StillDriver() { caps_.joints = caps_.tip_axes = 1; }
  const DeviceId& id() const noexcept override { return id_; }
  const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp&) override { return {}; }
  std::expected<Exchange, Errc> exchange(const ServoCommand&, State& state) noexcept override {
    ++state.seq;
    return Exchange::kFresh;
  }
  void send_zeros() noexcept override {}

 private:
  DeviceId id_{"still", "1"};
  DeviceCaps caps_;
};

struct Silent final : BringUp {
  void progress(std::string_view, double) override {}
  bool cancelled() const noexcept override { return false; }
};

struct Later final : ServoClient {
  Command tick(const State&) noexcept override {
    ticks.fetch_add(1);
    ticks.notify_all();
    return {};
  }
  Duration next_shift() noexcept override { return 1ms; }
  void lost(Errc) noexcept override {}
  std::atomic<int> ticks{0};
};

TEST(DeviceThread, ShiftsItsPeriodAsItsClientAsksByAtMostOnePercent) {
  constexpr int kTicks = 500;
  auto core = std::make_unique<ServoCore>(std::make_unique<StillDriver>());
  Silent silent;
  ASSERT_TRUE(core->bring_up(silent));
  DeviceThread device{std::move(core), 1ms};
  Later client;
  const Time begin = MonotonicClock{}.now();
  ASSERT_TRUE(device.start(client));
  for (int t = 0; t < kTicks; t = client.ticks.load()) client.ticks.wait(t);
  const Time end = MonotonicClock{}.now();
  device.close();
  // A lower limit, which holds however late the machine is: without shifts it would be 5 ms less.
  EXPECT_GE(end - begin, kTicks * 1ms + (kTicks - 1) * 10us);
}

}  // namespace
}  // namespace tandem::hal
