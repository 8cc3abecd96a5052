// The servo of a WoodenHaptics board in a process that is really killed, crashed or stopped. Its device model is at the
// other end of a socket that replaces the hidraw node.
// The layers between the two on a real machine (hidapi, the kernel, a Falcon's usbfs) are tested in the virtual
// machine: tests/vm/contact_test.cpp.
// A Falcon has no such test here: its shutdown frames are an ioctl that a socket does not support.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

#include "hal/drivers/woodenhaptics/board_report.h"
#include "hal/io/device_thread.h"
#include "hal/io/watchdog_process.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"
#include "tests/hal/emulation/devices/woodenhaptics_model.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// Pipe with hidraw's framing: a write begins with the report's number, which is 0.
class SocketPipe final : public hal::HidPipe {
 public:
  explicit SocketPipe(int fd) : fd_(fd) {}
  hal::Moved write(std::span<const std::byte> report) noexcept override {
    std::array<std::byte, 65> bytes{};
    std::ranges::copy(report, bytes.begin() + 1);
    if (::write(fd_, bytes.data(), report.size() + 1) < 0) return std::unexpected(hal::Errc::kUnplugged);
    return report.size();
  }
  hal::Moved read(std::span<std::byte> into, Duration timeout) noexcept override {
    pollfd file{fd_, POLLIN, 0};
    const auto whole = std::chrono::ceil<std::chrono::milliseconds>(std::max(timeout, Duration{})).count();
    if (::poll(&file, 1, static_cast<int>(whole)) <= 0) return std::size_t{0};
    const ssize_t got = ::read(fd_, into.data(), into.size());
    if (got <= 0) return std::unexpected(hal::Errc::kUnplugged);
    return static_cast<std::size_t>(got);
  }

 private:
  int fd_;
};

/// Client that pushes with some newtons without end.
struct Pusher final : hal::ServoClient {
  hal::Command tick(const hal::State&) noexcept override {
    hal::MonotonicClock clock;
    return {++seq, clock.now() + 5ms, hal::CommandKind::kJointEffort, {0.3, 0.3, 0.3}};
  }
  void lost(hal::Errc) noexcept override {}
  std::uint64_t seq = 0;
};

WoodenHapticsSpec arm(WoodenProtocol protocol) {
  WoodenHapticsSpec spec = wooden_2015();
  spec.protocol = protocol;
  spec.force_checked = true;
  return spec;
}

/// Runs a client's motor part. It ends by a signal only. @param speaker  whether it has a watchdog process
[[noreturn]] void servo(int fd, WoodenProtocol protocol, bool speaker) {
  SocketPipe pipe(fd);
  hal::MonotonicClock clock;
  auto driver = std::make_unique<hal::woodenhaptics::WoodenHapticsDriver>(
      hal::DeviceId{"woodenhaptics", "0001"}, pipe, clock,
      hal::woodenhaptics::WoodenHapticsOptions{.spec = arm(protocol), .enable_motors = true, .home_at_start = true});
  hal::ShutdownFrame words;
  words.fd = fd;
  words.size = 1 + hal::woodenhaptics::report_size(protocol);
  auto deadman = hal::WatchdogProcess::start({&words, speaker ? 1U : 0U});
  if (!deadman) ::_exit(2);
  auto core = std::make_unique<hal::ServoCore>(std::move(driver), hal::MotorSigns::kConfirmed);
  QuietBringUp quiet;
  if (!core->bring_up(quiet)) ::_exit(3);
  hal::DeviceThread device(std::move(core), 1ms, &(*deadman)->heartbeat());
  Pusher pusher;
  if (!device.start(pusher)) ::_exit(4);
  while (!device.enable()) ::poll(nullptr, 0, 1);
  for (;;) ::pause();
}

struct Order {
  int strength = 0;  ///< largest current [mA]
};

class KilledBoard : public testing::TestWithParam<WoodenProtocol> {
 protected:
  void start(bool speaker = true) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends.data()), 0);
    child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::close(ends[0]);
      servo(ends[1], GetParam(), speaker);
    }
    ::close(ends[1]);
    node = ends[0];
    model.place(model.tip());
    board = std::thread([this] { serve(); });
    ASSERT_TRUE(comes([&] { return orders.size() > 100 && orders.back().strength > kStrong; }));
  }
  void TearDown() override {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    if (board.joinable()) board.join();
    ::close(node);
  }
  /// Runs the board until no process holds its file.
  void serve() {
    hal::MonotonicClock clock;
    std::array<std::byte, 65> bytes{};
    for (Time before = clock.now();;) {
      pollfd file{node, POLLIN, 0};
      const int ready = ::poll(&file, 1, 1);
      const ssize_t got = ready > 0 ? ::recv(node, bytes.data(), bytes.size(), MSG_DONTWAIT) : -1;
      if (got == 0) return;
      const std::lock_guard hold(mutex);
      const Time now = clock.now();
      model.advance(std::min<Duration>(now - before, 5ms));  // its time stops while this machine's does
      before = now;
      if (got > 1) {
        EXPECT_TRUE(model.report_out(std::span(bytes).subspan(1, static_cast<std::size_t>(got) - 1)));
        const auto& current = model.host_report(0).current_ma;
        orders.push_back({std::max({std::abs(current[0]), std::abs(current[1]), std::abs(current[2])})});
      }
      while (const auto report = model.report_in(bytes))
        ::send(node, bytes.data(), *report, MSG_NOSIGNAL | MSG_DONTWAIT);
    }
  }
  bool comes(const std::function<bool()>& condition) {
    for (int i = 0; i < 30'000; ++i) {
      {
        const std::lock_guard hold(mutex);
        if (condition()) return true;
      }
      ::poll(nullptr, 0, 1);
    }
    return false;
  }
  /// The trailing commands are all without force, and at least three.
  void expect_only_zeros_at_the_end() {
    const std::lock_guard hold(mutex);
    const auto last = std::find_if(orders.rbegin(), orders.rend(), [](const Order& o) { return o.strength > 0; });
    const auto first_zero = std::find_if(orders.begin() + static_cast<std::ptrdiff_t>(before_event), orders.end(),
                                         [](const Order& o) { return o.strength == 0; });
    EXPECT_GE(last - orders.rbegin(), 3);
    EXPECT_EQ(last.base() - orders.begin(), first_zero - orders.begin()) << "force after a zero";
    EXPECT_EQ(model.motor_effort().norm(), 0);
  }
  void send(int signal) {
    const std::lock_guard hold(mutex);
    before_event = orders.size();
    ::kill(child, signal);
  }

  static constexpr int kStrong = 50;  // [mA]
  hal::emulation::WoodenHapticsModel model{WoodenHapticsFixture::at_calibration(arm(GetParam()), {})};
  std::mutex mutex;
  std::vector<Order> orders;
  std::size_t before_event = 0;
  std::thread board;
  pid_t child = 0;
  int node = -1;
};

TEST_P(KilledBoard, GetsZerosUntilItsFileIsClosed) {
  for (const int signal : {SIGKILL, SIGSEGV, SIGABRT}) {
    SCOPED_TRACE(signal);
    ASSERT_NO_FATAL_FAILURE(start());
    send(signal);
    board.join();  // the thread ends by itself: the watchdog process has ended too
    expect_only_zeros_at_the_end();
    if (signal == SIGABRT) return;
    TearDown();
    orders.clear();
  }
}

TEST_P(KilledBoard, PushesUntilItsOwnWatchdogWithoutAWatchdogProcess) {
  ASSERT_NO_FATAL_FAILURE(start(false));
  send(SIGKILL);
  board.join();
  EXPECT_GT(orders.back().strength, kStrong) << "the force was not removed";
  const Time heard = model.host_report(0).at;
  model.advance(heard + hal::emulation::WoodenHapticsModel::kWatchdog - 1ms - model.now());
  EXPECT_GT(model.motor_effort().norm(), 0);
  model.advance(1ms);
  if (GetParam() == WoodenProtocol::kRaw64) {
    model.advance(10s);
    EXPECT_GT(model.motor_effort().norm(), 0) << "no watchdog is published for these boards: tests assume the worst";
  } else {
    EXPECT_EQ(model.motor_effort().norm(), 0);
  }
}

TEST_P(KilledBoard, GetsZerosAndNoStaleForceFromAStoppedProgram) {
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_TRUE(comes([&] { return orders.size() > 700; }));  // its soft start is over
  send(SIGSTOP);
  ASSERT_TRUE(comes([&] { return orders.size() > before_event + 10 && orders.back().strength == 0; }));
  expect_only_zeros_at_the_end();
  const int full = orders[before_event - 1].strength;
  // Wait for all hundred zero frames, so that later frames come from the program.
  std::size_t at_rest = 0;
  ASSERT_TRUE(comes([&] { return std::exchange(at_rest, orders.size()) >= before_event + 90; }));
  send(SIGCONT);
  ASSERT_TRUE(comes([&] { return orders.size() > before_event + 600; }));
  const std::lock_guard hold(mutex);
  std::ptrdiff_t stale = 0;
  for (std::size_t i = before_event; i < before_event + 50; ++i) stale += orders[i].strength > full / 4 ? 1 : 0;
  EXPECT_LE(stale, 1) << "forces restart at zero, except a report that was being written when it was stopped";
}

INSTANTIATE_TEST_SUITE_P(Protocols, KilledBoard,
                         testing::Values(WoodenProtocol::kV1, WoodenProtocol::kV2, WoodenProtocol::kRaw64),
                         [](const auto& kind) {
                           return kind.param == WoodenProtocol::kV1   ? "V1"
                                  : kind.param == WoodenProtocol::kV2 ? "V2"
                                                                      : "Raw64";
                         });

}  // namespace
}  // namespace tandem::test
