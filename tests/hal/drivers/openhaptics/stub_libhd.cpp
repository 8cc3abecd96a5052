#include "tests/hal/drivers/openhaptics/stub_libhd.h"

#include <algorithm>

// Tandem's own libHD.so for tests: the calls Tandem makes, with their public prototypes. It contains nothing of the
// vendor.

using tandem::test::StubDevice;
using tandem::test::StubError;
using tandem::test::StubHd;

namespace {
StubHd state;

constexpr std::uint32_t kNone = 0xffffffff;

void raise(std::uint32_t code, std::uint32_t device, std::int32_t internal = 0) {
  state.errors.push_back({code, internal, device});
}
void broke(const std::string& rule) {
  if (std::ranges::find(state.broken, rule) == state.broken.end()) state.broken.push_back(rule);
}

StubDevice* current(bool frame) {
  if (state.current >= state.devices.size() || !state.devices[state.current].initialised) {
    broke("no current device");
    return nullptr;
  }
  if (frame && state.in_frame != state.current) broke("outside a frame");
  StubDevice& d = state.devices[state.current];
  ++d.touched;
  if (d.unplugged) {
    raise(0x0302, state.current, -5);
    return nullptr;
  }
  return &d;
}
}  // namespace

extern "C" {

StubHd* stub_hd() { return &state; }

std::uint32_t hdInitDevice(const char* name) {
  if (state.running) broke("init while the scheduler runs");
  for (std::uint32_t i = 0; i < state.devices.size(); ++i) {
    StubDevice& d = state.devices[i];
    if (name != nullptr && d.name != name) continue;  // null: the default device, here the first
    if (d.init_error != 0 || d.unplugged) {
      raise(d.unplugged ? 0x0302 : d.init_error, kNone);
      return kNone;
    }
    if (d.held || d.initialised) {
      raise(0x0301, i);
      return kNone;
    }
    d.initialised = true;
    d.force = {};
    state.current = i;
    return i;
  }
  raise(0x0300 + 2, kNone, -1);
  return kNone;
}
void hdDisableDevice(std::uint32_t h) {
  if (state.running) broke("disable while the scheduler runs");
  if (h >= state.devices.size()) return raise(0x0104, h);
  StubDevice& d = state.devices[h];
  ++d.touched;
  d.initialised = d.held = d.force_enabled = false;
}
void hdMakeCurrentDevice(std::uint32_t h) {
  if (h >= state.devices.size() || !state.devices[h].initialised) return raise(0x0104, h);
  ++state.devices[h].touched;
  state.current = h;
}
void hdBeginFrame(std::uint32_t h) {
  if (state.in_frame != kNone) broke("frame in a frame");
  state.in_frame = h;
  if (StubDevice* d = current(false)) ++d->frames;
}
void hdEndFrame(std::uint32_t h) {
  if (state.in_frame != h) broke("end of another frame");
  state.in_frame = kNone;
  if (StubDevice* d = current(false); d != nullptr && d->cycle_error != 0) {
    raise(d->cycle_error, h);
    d->cycle_error = 0;
  }
}
StubError hdGetError() {
  if (state.errors.empty()) return {0, 0, kNone};
  const StubError e = state.errors.back();
  state.errors.pop_back();
  return e;
}
const char* hdGetErrorString(std::uint32_t code) { return code == 0x0600 ? "stub: no licence" : "stub: some error"; }
void hdEnable(std::uint32_t what) {
  if (StubDevice* d = current(false); d != nullptr && what == 0x4000) d->force_enabled = true;
}
void hdGetIntegerv(std::uint32_t what, std::int32_t* into) {
  StubDevice* d = current(what == 0x2000 || what == 0x2010);
  if (d == nullptr) return;
  switch (what) {
    case 0x2000:
      *into = d->buttons;
      break;
    case 0x2010:
      std::ranges::copy(d->encoders, into);
      break;
    case 0x2553:
      *into = d->sensed;
      break;
    case 0x2554:
      *into = d->actuated;
      break;
    case 0x2555:
      *into = d->style;
      break;
    default:
      raise(0x0100, state.current);
      break;
  }
}
void hdGetDoublev(std::uint32_t what, double* into) {
  StubDevice* d = current(what == 0x2050 || what == 0x2051);
  if (d == nullptr) return;
  switch (what) {
    case 0x2050:
      std::ranges::copy(d->x, into);
      break;
    case 0x2051:
      std::ranges::copy(d->v, into);
      break;
    case 0x2551:
      std::ranges::copy(d->workspace, into);
      break;
    case 0x2603:
      *into = d->force_max;
      break;
    case 0x2604:
      *into = d->force_continuous;
      break;
    case 0x2605:
      if (!d->tells_heat) return raise(0x0100, state.current);
      std::ranges::copy(d->heat, into);
      break;
    default:
      raise(0x0100, state.current);
      break;
  }
}
void hdSetDoublev(std::uint32_t what, const double* values) {
  StubDevice* d = current(true);
  if (d == nullptr) return;
  if (what != 0x2700) return raise(0x0100, state.current);
  if (!d->force_enabled) broke("force without force output");
  d->force = {values[0], values[1], values[2]};
  d->force_set = true;
}
const char* hdGetString(std::uint32_t what) {
  current(false);
  return what == 0x2501 ? "Stub Touch" : what == 0x2504 ? "S-1" : "3.4.0";
}
void hdStartScheduler() {
  if (state.scheduler_fails) return raise(0x0304, kNone);
  if (state.running) broke("two schedulers");
  state.running = true;
}
void hdStopScheduler() {
  for (const StubDevice& d : state.devices)
    if (d.initialised && !d.unplugged && d.force != std::array<double, 3>{}) broke("stopped with a force on");
  state.running = false;
}
void hdSetSchedulerRate(unsigned long) {}
unsigned long hdScheduleAsynchronous(std::uint32_t (*callback)(void*), void* data, std::uint16_t) {
  if (state.callback != nullptr) broke("two callbacks");
  state.callback = callback;
  state.data = data;
  return 7;
}
void hdUnschedule(unsigned long which) {
  if (which != 7 || state.callback == nullptr) broke("unscheduled what is not scheduled");
  state.callback = nullptr;
}
#ifndef STUB_TOO_OLD
std::uint32_t hdCheckCalibration() {
  StubDevice* d = current(state.running);
  return d == nullptr ? 0x5002 : d->calibration;
}
void hdUpdateCalibration(std::uint32_t style) {
  if (style == 1 && state.running) broke("encoders reset under a running servo");
  StubDevice* d = current(style != 1);
  if (d == nullptr) return;
  if (d->reset_error != 0) return raise(d->reset_error, state.current);
  if ((static_cast<std::uint32_t>(d->style) & style) == 0) return raise(0x0101, state.current);
  ++d->calibrations;
  if (d->calibration == 0x5001 || style == 1) d->calibration = 0x5000;
}
#endif
}
