// Ends or stalls a client in contact by every kind of signal, and checks the commands that its device receives after
// that. Runs in the virtual machine: libusb, hidapi, usbfs, hidraw, fork and signals are the real ones, time is the
// machine's.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <thread>

#include "hal/io/hotplug.h"
#include "tests/vm/plug.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// Maximum time from the end of the client, or from its last exchange, to the first zeros: the watchdog's time-out, two
/// of its poll intervals, and the time that the kernel needs to end a process.
constexpr Duration kPromised = 40ms;
/// Maximum time from a request to end to the last force: the client polls every 100 ms, ramps for 100 ms and damps for
/// 500 ms.
constexpr Duration kLetGo = 1s;
constexpr Duration kStale = 100ms;
constexpr double kRampIn = 10;            // [N/s]
constexpr Duration kSeatIsFree = 2500ms;  // after the last datagram of its owner
constexpr double kContact = 1;            // [N]

double ms(Duration d) { return 1e3 * seconds(d); }

/// Returns the id of the watchdog process, which sends zeros when its client cannot; 0: none runs.
pid_t deadman() {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string pid = entry.path().filename();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream file(entry.path() / "stat");
    const std::string stat((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (stat.find("(tandem-watchdog)") != std::string::npos && stat.find(") Z") == std::string::npos)
      return std::stoi(pid);
  }
  return 0;
}

template <class Condition>
bool within(Duration limit, Condition condition) {
  for (Duration waited{}; waited < limit; waited += 1ms) {
    if (condition()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return condition();
}

/// An attached device with a log of the commands that it received.
struct Desk {
  explicit Desk(Kind kind, Found found = Found::kReady) : plug(plug_in(kind, folder, found)) {
    EXPECT_TRUE(plug->attached());
    auto watch = hal::HotplugMonitor::open();
    EXPECT_TRUE(watch && within(20s,
                                [&] {
                                  (void)(*watch)->wait(100ms);
                                  return !(*watch)->present().empty();
                                }))
        << "the kernel or udev did not show the device";
    log = std::jthread([this](std::stop_token stop) {
      for (; !stop.stop_requested(); std::this_thread::sleep_for(20ms)) note_orders();
    });
  }
  void note_orders() {
    const std::lock_guard hold(mutex);
    for (const Order& order : plug->take()) orders.push_back(order);
  }
  std::vector<Order> seen() {
    note_orders();
    const std::lock_guard hold(mutex);
    return orders;
  }
  /// Clears the log of commands. @return now, in the device's time
  Time begin_anew() {
    note_orders();
    const std::lock_guard hold(mutex);
    orders.clear();
    return plug->now();
  }

  /// Returns the arguments of `join` that name the state directory with this device's confirmed motors.
  [[nodiscard]] Words confirmed() const {
    const std::string state = plug->state();
    return state.empty() ? Words{} : Words{"--state", state};
  }

  Folder folder;
  std::unique_ptr<Plug> plug;
  std::mutex mutex;
  std::vector<Order> orders;
  std::jthread log;
};

/// A session of scene `devices`: the device of `desk` in seat trainer, a simulated device in seat trainee.
struct Contact : testing::TestWithParam<Kind> {
  void SetUp() override {
    server = hosting("devices", {"--listen", "127.0.0.1:0"});
    address = address_of(server);
    ASSERT_FALSE(address.empty()) << server.err();
    trainee = client(address, "trainee");
    trainer = join();
    press();
  }
  void TearDown() override {
    if (HasFailure())
      std::printf("client: %s\nserver: %s%s\n", trainer.err().c_str(), server.out().c_str(), server.err().c_str());
  }
  [[nodiscard]] Process join() const {
    desk.plug->rest();
    return client(address, "trainer", desk.confirmed(), desk.plug->words());
  }

  /// Moves the hand into the block until the motors push back.
  void press() {
    ASSERT_TRUE(trainer.wait_for("the session runs"));
    desk.plug->carry();
    std::this_thread::sleep_for(1s);
    for (double x = 0; x < 0.05 && desk.plug->force() < kContact; x += 0.0001) {
      desk.plug->hold(x);
      std::this_thread::sleep_for(1ms);
    }
    std::this_thread::sleep_for(50ms);
    ASSERT_GT(desk.plug->force(), kContact / 2) << "no contact";
  }
  /// Checks the commands after `at`: the first without force arrived within `limit`, and none with force followed.
  void expect_zeros_after(Time at, Duration limit, const char* what) {
    std::size_t forces = 0, zeros = 0;
    std::optional<Time> silent;
    Time last = at;
    for (const Order& order : desk.seen()) {
      if (order.at < at) continue;
      last = order.at;
      if (!order.force) {
        ++zeros;
        if (!silent) silent = order.at;
        continue;
      }
      ++forces;
      EXPECT_FALSE(silent) << "force again " << ms(order.at - at) << " ms after " << what;
    }
    EXPECT_GE(zeros, 3U);
    ASSERT_TRUE(silent);
    EXPECT_LE(ms(*silent - at), ms(limit));
    std::printf("[  guest   ] %s: %zu more orders with force, zeros from %.2f ms on, %zu of them until %.0f ms\n", what,
                forces, ms(*silent - at), zeros, ms(last - at));
    EXPECT_EQ(desk.plug->force(), 0);
  }
  /// Checks the commands after `at`: the last with force, at the end of the ramp, arrived within `limit`; zeros
  /// followed.
  void expect_end_in_zeros_after(Time at, Duration limit, const char* what) {
    std::size_t forces = 0, zeros = 0;
    Time last = at;
    for (const Order& order : desk.seen()) {
      if (order.at < at) continue;
      zeros = order.force ? 0 : zeros + 1;
      forces += order.force ? 1 : 0;
      if (order.force) last = order.at;
    }
    EXPECT_GE(zeros, 3U);
    EXPECT_LE(ms(last - at), ms(limit));
    EXPECT_EQ(desk.plug->force(), 0);
    std::printf("[  guest   ] %s: %zu orders with force until %.1f ms, then %zu without\n", what, forces, ms(last - at),
                zeros);
  }
  /// Checks for `time` from now on that the force begins at zero and grows no faster than a force gate ramps it in.
  void expect_gentle_force(Duration time, const char* what) {
    std::optional<Time> first;
    double most = 0, steepest = 0;
    const Time begin = desk.plug->now();
    for (Time now = begin; now < begin + time; now = desk.plug->now()) {
      const double force = desk.plug->force();
      if (force > 0 && !first) first = now;
      const double allowed = first ? kRampIn * seconds(now - *first) + 0.1 : 0.0;
      EXPECT_LE(force, allowed) << ms(now - first.value_or(now)) << " ms after it began";
      if (first && now > *first + 20ms) steepest = std::max(steepest, force / seconds(now - *first));
      most = std::max(most, force);
      std::this_thread::sleep_for(2ms);
    }
    std::printf("[  guest   ] %s: force from %.0f ms on, at most %.2f N, on the whole no faster than %.1f N/s\n", what,
                first ? ms(*first - begin) : -1.0, most, steepest);
  }

  Desk desk{GetParam()};
  Process server{{"/bin/true"}}, trainee{{"/bin/true"}}, trainer{{"/bin/true"}};
  std::string address;
};

TEST_P(Contact, GetsZerosFromTheWatchdogAfterAKillAndRampsUpForTheNextClient) {
  ASSERT_NE(deadman(), 0);
  const Time at = desk.begin_anew();
  trainer.signal(SIGKILL);
  std::this_thread::sleep_for(250ms);
  expect_zeros_after(at, kPromised, "kill -9");
  EXPECT_EQ(trainer.wait(), -SIGKILL);
  EXPECT_EQ(deadman(), 0) << "its process ends";

  std::this_thread::sleep_for(kSeatIsFree);
  desk.begin_anew();
  trainer = join();  // no process has the device open; a Falcon's grip is still in the block
  expect_gentle_force(2s, "the next client");
  EXPECT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  std::size_t zeros = 0;
  for (const Order& order : desk.seen()) {
    if (order.force) break;
    ++zeros;
  }
  EXPECT_GE(zeros, 3U) << "a host that connects again begins with zeros";
}

TEST_P(Contact, LeavesTheDevicesOwnWatchdogWhenClientAndWatchdogAreKilled) {
  const pid_t speaker = deadman();
  ASSERT_NE(speaker, 0);
  ::kill(speaker, SIGKILL);
  trainer.signal(SIGKILL);
  EXPECT_EQ(trainer.wait(), -SIGKILL);
  const Time at = desk.begin_anew();
  std::this_thread::sleep_for(400ms);
  EXPECT_TRUE(desk.seen().empty()) << "no program is left to command it";
  EXPECT_GT(desk.plug->force(), kContact / 2) << "it still pushes";
  const Duration watchdog = desk.plug->watchdog();
  if (watchdog > Duration::zero()) {
    EXPECT_TRUE(within(watchdog, [&] { return desk.plug->force() == 0; }));
    std::printf("[  guest   ] kill -9 of both: the board's own watchdog ended the force after %.0f ms\n",
                ms(desk.plug->now() - at));
    EXPECT_LE(ms(desk.plug->now() - at), ms(watchdog) + 20);
    return;
  }
  std::this_thread::sleep_for(1s);
  EXPECT_GT(desk.plug->force(), kContact / 2);
  std::printf("[  guest   ] kill -9 of both: the device still pushes with %.2f N after %.0f ms\n", desk.plug->force(),
              ms(desk.plug->now() - at));
  trainer = join();
  EXPECT_TRUE(within(5s, [&] { return desk.plug->force() == 0; }))
      << "the next program that opens it removes the force";
}

struct ContactOfTwo : Contact {};

TEST_P(ContactOfTwo, GetsZerosInAHalfSecondPauseAndNoStaleForceAfterIt) {
  const Time at = desk.begin_anew();
  trainer.signal(SIGSTOP);
  std::this_thread::sleep_for(500ms);
  expect_zeros_after(at, kPromised, "SIGSTOP");
  const Time on = desk.begin_anew();
  trainer.signal(SIGCONT);
  expect_gentle_force(1s, "SIGCONT");
  std::size_t stale = 0;
  if (HasFailure()) {
    for (const Order& order : desk.seen()) {
      if (order.at < on + kStale) std::printf("order after %.2f ms: %d\n", ms(order.at - on), order.strength);
    }
  }
  for (const Order& order : desk.seen()) stale += order.force && order.at < on + kStale ? 1 : 0;
  EXPECT_LE(stale, 1U) << "but for a frame that was being sent when it was stopped";
  EXPECT_FALSE(desk.seen().empty()) << "it goes on";
}

/// Returns whether the crash of another program writes the file "core" in this folder.
bool crash_of_another_leaves_a_core() {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit cores{RLIM_INFINITY, RLIM_INFINITY};
    ::setrlimit(RLIMIT_CORE, &cores);
    ::signal(SIGABRT, SIG_DFL);
    ::raise(SIGABRT);
    ::_exit(1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return std::filesystem::remove("core") && WIFSIGNALED(status) && WCOREDUMP(status);
}

// The client forbids core dumps at its start, because its memory holds keys. A crash therefore ends it at once, and the
// watchdog finds its socket closed. A limit that root raises afterwards has no effect: the process stays undumpable. A
// crash that takes longer to end the process is a stall, as in the test above.
TEST_P(ContactOfTwo, GetsZerosWithinTheLimitAfterACrashAndWritesNoCoreFile) {
  std::ofstream("/proc/sys/kernel/core_pattern") << "core";
  ASSERT_TRUE(crash_of_another_leaves_a_core());
  const rlimit cores{RLIM_INFINITY, RLIM_INFINITY};
  ASSERT_EQ(prlimit(trainer.id(), RLIMIT_CORE, &cores, nullptr), 0);
  for (const int signal : {SIGSEGV, SIGABRT}) {
    const Time at = desk.begin_anew();
    trainer.signal(signal);
    EXPECT_EQ(trainer.wait(), -signal);
    const Time ended = desk.plug->now();
    std::this_thread::sleep_for(250ms);  // the watchdog sends its zeros 100 times, 1 ms apart
    expect_zeros_after(at, kPromised, signal == SIGSEGV ? "SIGSEGV" : "SIGABRT");
    EXPECT_EQ(deadman(), 0) << "its process ends";
    EXPECT_FALSE(std::filesystem::exists("core")) << "the client's memory holds keys";
    std::printf("[  guest   ] signal %d: the process was there for %.0f ms, no core\n", signal, ms(ended - at));
    if (signal == SIGABRT) return;
    std::this_thread::sleep_for(kSeatIsFree);
    trainer = join();
    ASSERT_NO_FATAL_FAILURE(press());
  }
}

TEST_P(ContactOfTwo, ReleasesAndEndsWithZerosOnRequest) {
  for (const int signal : {SIGTERM, SIGINT}) {
    const Time at = desk.begin_anew();
    trainer.signal(signal);
    EXPECT_EQ(trainer.wait(), 0);
    expect_end_in_zeros_after(at, kLetGo, signal == SIGTERM ? "SIGTERM" : "Ctrl-C");
    EXPECT_EQ(deadman(), 0);
    if (signal == SIGINT) return;
    trainer = join();  // after a clean end the seat is free
    ASSERT_NO_FATAL_FAILURE(press());
  }
}

TEST_P(ContactOfTwo, ReleasesWhenTheWatchdogProcessEnds) {
  const Time at = desk.begin_anew();
  ::kill(deadman(), SIGKILL);
  EXPECT_EQ(trainer.wait(), 0);
  expect_end_in_zeros_after(at, kLetGo, "kill -9 of the watchdog process");
  EXPECT_NE(trainer.err().find("the process tandem-watchdog ended, which sends zero forces"), std::string::npos);
}

struct Phases : testing::TestWithParam<Kind> {
  /// Ends clients by each signal, after `far_enough` has returned true. Expects no command with force, and zeros at the
  /// end.
  void end_in_every_way(Found found, const char* phase, const std::function<bool(Desk&, Process&)>& far_enough) {
    Desk desk{GetParam(), found};
    for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGKILL}) {
      SCOPED_TRACE(signal);
      Words more = desk.confirmed();
      more.insert(more.end(), {"--timeout", "30"});
      Process person = client("127.0.0.1:9", "trainer", more, desk.plug->words());
      ASSERT_TRUE(far_enough(desk, person)) << person.err();
      const Time at = desk.begin_anew();
      person.signal(signal);
      EXPECT_EQ(person.wait(), signal == SIGINT || signal == SIGTERM ? 1 : -signal)
          << person.err();  // 1: the client joined no session
      EXPECT_TRUE(within(300ms, [] { return deadman() == 0; }));
      std::size_t zeros = 0;
      for (const Order& order : desk.seen()) {
        EXPECT_FALSE(order.force);
        zeros += order.at >= at ? 1 : 0;
      }
      std::printf("[  guest   ] signal %d while %s: %zu orders after it, none with force\n", signal, phase, zeros);
      EXPECT_TRUE(zeros >= 3 || found == Found::kNoFirmware);
      EXPECT_EQ(desk.plug->force(), 0);
    }
  }
};

TEST_P(Phases, LeaveZerosWhenEndedBeforeTheFirstForce) {
  end_in_every_way(Found::kUnhomed, "being homed",
                   [](Desk&, Process& person) { return person.wait_for("home the device"); });
  end_in_every_way(Found::kReady, "waiting for a seat",
                   [](Desk& desk, Process&) { return within(20s, [&] { return desk.seen().size() > 100; }); });
  if (GetParam() != Kind::kFalcon) return;
  end_in_every_way(Found::kNoFirmware, "loading firmware", [](Desk&, Process& person) {
    const bool begun = person.wait_for("%") && person.wait_for("firmware");
    std::this_thread::sleep_for(200ms);
    return begun;
  });
}

std::string name_of(Kind kind) {
  return kind == Kind::kFalcon ? "Falcon" : kind == Kind::kBoardV1 ? "BoardV1" : "BoardV2";
}
constexpr auto kName = [](const auto& kind) { return name_of(kind.param); };

INSTANTIATE_TEST_SUITE_P(Devices, Contact, testing::Values(Kind::kFalcon, Kind::kBoardV1, Kind::kBoardV2), kName);
INSTANTIATE_TEST_SUITE_P(Devices, ContactOfTwo, testing::Values(Kind::kFalcon, Kind::kBoardV2), kName);
INSTANTIATE_TEST_SUITE_P(Devices, Phases, testing::Values(Kind::kFalcon, Kind::kBoardV2), kName);

}  // namespace
}  // namespace tandem::test
