// 1 kHz through the real libraries, without requirements on the machine: the tests assert exchanges and heap use, and
// print rates.
#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <barrier>
#include <cstdio>
#include <thread>

#include "common/base/histogram.h"
#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "hal/io/hid_pipe.h"
#include "hal/io/usb_pipe.h"
#include "tests/common/base/counts.h"
#include "tests/hal/emulation/echo_model.h"
#include "tests/hal/emulation/testbed.h"
#include "tests/support/alloc_guard.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

struct Course {
  std::uint64_t exchanges = 0, wrong = 0, late = 0, heap = 0;
  Duration cpu{}, took{};
  bool realtime = false;
  Histogram round_trip;  ///< [ns]
};

/// Performs `ticks` exchanges, one per millisecond; after a missed millisecond the next exchange keeps its schedule.
template <class Exchange>
void run(std::uint64_t ticks, Exchange exchange, Course& course) {
  // Priority of a device's own thread. If the system refuses it, the figures include the load of other programs.
  constexpr int kPriority = 80;
  course.realtime = io::request_realtime(kPriority);
  const Time began = io::monotonic_now();
  const Duration cpu_before = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
  const AllocGuard heap;
  const auto inside_before = Node::heap_inside();
  Time next = began;
  for (std::uint64_t i = 0; i < ticks; ++i) {
    const timespec until = io::to_timespec(next.time_since_epoch());
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
    }
    const Time start = io::monotonic_now();
    course.wrong += exchange(i) ? 0 : 1;
    ++course.exchanges;
    const Time end = io::monotonic_now();
    course.round_trip.add((end - start).count());
    next += 1ms;
    if (end > next + 1ms) {
      ++course.late;
      next = end;
    }
  }
  course.heap = heap.count() - (Node::heap_inside() - inside_before);
  course.cpu = io::read_clock(CLOCK_THREAD_CPUTIME_ID) - cpu_before;
  course.took = io::monotonic_now() - began;
  if (course.realtime) {
    const sched_param ordinary{};
    sched_setscheduler(0, SCHED_OTHER, &ordinary);
  }
}

void print(const char* what, const Course& c) {
  std::printf(
      "[   rate   ] %s: %.1f Hz, %llu exchanges, %llu periods skipped, round trip p50 %.1f p99.9 %.1f us, CPU of its "
      "thread "
      "%.1f %% of a core with the emulated kernel's part, SCHED_FIFO %s\n",
      what, static_cast<double>(c.exchanges) / seconds(c.took), static_cast<unsigned long long>(c.exchanges),
      static_cast<unsigned long long>(c.late), static_cast<double>(c.round_trip.quantile(0.5)) * 1e-3,
      static_cast<double>(c.round_trip.quantile(0.999)) * 1e-3, 100 * seconds(c.cpu) / seconds(c.took),
      c.realtime ? "granted" : "refused");
}

std::array<std::byte, 16> stamp(std::uint64_t i) {
  std::array<std::byte, 16> out{};
  std::memcpy(out.data(), &i, sizeof i);
  return out;
}

struct UsbSeat {
  explicit UsbSeat(Testbed& bed, const std::string& port) {
    bed.plug(node, model, port);
    hal::DeviceFilter wanted{"echo", {}, {}, {}, port};
    auto opened = hal::LibusbPipe::open(*hal::select_device(hal::list_usb(), wanted));
    EXPECT_TRUE(opened) << opened.error().message;
    pipe = std::move(*opened);
  }
  bool exchange(std::uint64_t i) {
    const auto frame = stamp(i);
    if (pipe->write(frame, 5s).value_or(0) != frame.size()) return false;
    std::array<std::byte, UsbEcho::kPacket> packet{};
    for (int tries = 0; tries < 1000; ++tries) {
      const auto got = pipe->read(packet, 5s);
      if (!got || *got < UsbEcho::kStatus) return false;
      if (*got == UsbEcho::kStatus) continue;  // a packet of the latency timer
      return *got == UsbEcho::kStatus + frame.size() &&
             std::equal(frame.begin(), frame.end(), packet.begin() + UsbEcho::kStatus);
    }
    return false;
  }
  UsbEcho model;
  UsbfsNode node{model};
  std::unique_ptr<hal::LibusbPipe> pipe;
};

struct HidSeat {
  explicit HidSeat(Testbed& bed, const std::string& port) {
    bed.plug(node, model, port);
    hal::DeviceFilter wanted{"echo", {}, {}, {}, port};
    auto opened = hal::HidrawPipe::open(*hal::select_device(hal::list_hidraw(), wanted));
    EXPECT_TRUE(opened) << opened.error().message;
    pipe = std::move(*opened);
  }
  bool exchange(std::uint64_t i) {
    const auto whole = stamp(i);
    const auto report = std::span(whole).first(14);
    if (pipe->write(report).value_or(0) != report.size()) return false;
    std::array<std::byte, 64> into{};
    for (int tries = 0; tries < 1000; ++tries) {
      const auto got = pipe->read(into, 5s);
      if (!got) return false;
      if (*got > 0) return *got == report.size() && std::equal(report.begin(), report.end(), into.begin());
    }
    return false;
  }
  HidEcho model;
  HidrawNode node{model};
  std::unique_ptr<hal::HidrawPipe> pipe;
};

void expect_clean(const Course& c, std::uint64_t ticks) {
  EXPECT_EQ(c.exchanges, ticks);
  EXPECT_EQ(c.wrong, 0u);
  EXPECT_EQ(c.heap, 0u);
}

/// Returns the number of ticks; 60 s with --full and --nightly.
std::uint64_t ticks() { return draws(2000, 60000, 60000); }

TEST(ServoRate, MeasuresAnEmptyLoop) {
  Course course;
  run(ticks(), [](std::uint64_t) { return true; }, course);
  print("an empty loop", course);
  expect_clean(course, ticks());
}

TEST(ServoRate, MeasuresOneUsbDevice) {
  Testbed bed;
  UsbSeat seat(bed, "1-2");
  Course course;
  run(ticks(), [&](std::uint64_t i) { return seat.exchange(i); }, course);
  print("one USB device", course);
  expect_clean(course, ticks());
}

TEST(ServoRate, MeasuresOneHidDevice) {
  Testbed bed;
  HidSeat seat(bed, "1-2");
  Course course;
  run(ticks(), [&](std::uint64_t i) { return seat.exchange(i); }, course);
  print("one HID device", course);
  expect_clean(course, ticks());
}

TEST(ServoRate, MeasuresThreeDevicesAtOnce) {
  Testbed bed;
  UsbSeat first(bed, "1-2"), second(bed, "1-3");
  HidSeat third(bed, "1-4");
  std::array<Course, 3> courses;
  std::barrier together(3);
  const auto thread = [&](auto& seat, Course& course) {
    return std::jthread([&] {
      together.arrive_and_wait();
      run(ticks(), [&](std::uint64_t i) { return seat.exchange(i); }, course);
    });
  };
  {
    const auto a = thread(first, courses[0]), b = thread(second, courses[1]), c = thread(third, courses[2]);
  }
  print("three at once, USB", courses[0]);
  print("three at once, USB", courses[1]);
  print("three at once, HID", courses[2]);
  for (const Course& course : courses) expect_clean(course, ticks());
}

TEST(ServoRate, MeasuresTheUnpacedRate) {
  Testbed bed;
  UsbSeat usb(bed, "1-2");
  HidSeat hid(bed, "1-3");
  const auto time = [](const char* what, auto& seat, std::uint64_t count) {
    const Time began = io::monotonic_now();
    std::uint64_t wrong = 0;
    for (std::uint64_t i = 0; i < count; ++i) wrong += seat.exchange(i) ? 0 : 1;
    std::printf("[   rate   ] %s, as fast as it goes: %.0f exchanges/s\n", what,
                static_cast<double>(count) / seconds(io::monotonic_now() - began));
    EXPECT_EQ(wrong, 0u);
  };
  time("USB", usb, draws(5000, 100000, 1000000));
  time("HID", hid, draws(2000, 20000, 100000));
}

}  // namespace
}  // namespace tandem::test
