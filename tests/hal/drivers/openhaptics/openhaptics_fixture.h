#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/core/servo_core.h"
#include "hal/drivers/openhaptics/openhaptics_driver.h"
#include "hal/io/openhaptics_library.h"
#include "tests/hal/drivers/openhaptics/stub_libhd.h"

namespace tandem::hal::openhaptics {

using namespace std::chrono_literals;
using test::StubDevice;
using test::StubHd;

inline StubHd& stub() {
  static StubHd* const hd = [] {
    void* library = dlopen(STUB_LIBHD, RTLD_NOW | RTLD_LOCAL);
    return reinterpret_cast<StubHd* (*)()>(dlsym(library, "stub_hd"))();
  }();
  return *hd;
}

/// Clock that waiting advances; it runs the vendor's scheduler once per millisecond.
struct TurningClock final : Clock {
  Time at = Time{} + 1h, next = at + 1ms;
  Time now() noexcept override { return at; }
  void wait_until(Time until) noexcept override {
    for (; next <= until; next += 1ms) {
      at = next;
      if (!frozen) stub().cycle();
    }
    at = std::max(at, until);
  }
  bool frozen = false;
};

struct Patient final : BringUp {
  void progress(std::string_view, double) override {}
  bool cancelled() const noexcept override { return false; }
  bool request_user_action(std::string_view request) override {
    asked.emplace_back(request);
    if (meanwhile) meanwhile();
    return answers;
  }
  std::vector<std::string> asked;  ///< requests to the user
  bool answers = false;            ///< whether a user answers
  std::function<void()> meanwhile;
};

struct Pusher final : ServoClient {
  AxisArray effort{};
  State seen;
  Errc why = Errc::kInternal;
  unsigned ticks = 0, losses = 0;
  Command tick(const State& s) noexcept override {
    seen = s;
    Command c;
    c.seq = ++ticks;
    c.kind = CommandKind::kJointEffort;
    c.effort = effort;
    c.expires = s.sampled_at + 5ms;
    return c;
  }
  void lost(Errc e) noexcept override {
    ++losses;
    why = e;
  }
};

class OpenHaptics : public testing::Test {
 protected:
  OpenHaptics() {
    stub().reset();
    stub().devices.resize(1);
    auto loaded = OpenHapticsLibrary::load(STUB_LIBHD);
    EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().message);
    library = *loaded;
    group = std::make_shared<TouchGroup>(library->api(), clock);
  }
  ~OpenHaptics() override { EXPECT_TRUE(stub().broken.empty()) << stub().broken.front(); }

  std::unique_ptr<ServoCore> core(const std::string& name = "Default Device", bool home_at_start = false) {
    return std::make_unique<ServoCore>(std::make_unique<OpenHapticsDriver>(name, group, clock, home_at_start));
  }
  void run(std::initializer_list<std::pair<ServoCore*, Pusher*>> devices, Duration time) {
    for (const Time end = clock.now() + time; clock.now() < end;) {
      clock.wait_until(clock.now() + 1ms);
      for (const auto& [c, p] : devices) c->step(clock.now(), *p);
    }
  }

  TurningClock clock;
  Patient patient;
  std::shared_ptr<OpenHapticsLibrary> library;
  std::shared_ptr<TouchGroup> group;
};

}  // namespace tandem::hal::openhaptics
