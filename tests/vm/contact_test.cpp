// The client as users run it, in contact, ended in every way there is; what counts is what the device was ordered after that.
// Runs in the virtual machine: libusb, hidapi, usbfs, hidraw, fork and signals are the real ones, time is the machine's.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

#include "hal/io/hotplug.h"
#include "tests/vm/plug.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// From death or the last exchange to the first zeros: the deadman's patience, twice its look, and a dying process's tidying.
constexpr Duration kPromised = 40ms;
constexpr Duration kSeatIsFree = 2500ms;  // after its owner fell silent
constexpr double kContact = 1;  // [N]

double ms(Duration d) { return 1e3 * seconds(d); }

/// The process that speaks when its client cannot; 0: there is none (any more).
pid_t deadman() {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string pid = entry.path().filename();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream file(entry.path() / "stat");
    const std::string stat((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (stat.find("(tandem-deadman)") != std::string::npos && stat.find(") Z") == std::string::npos) return std::stoi(pid);
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

struct Contact : testing::TestWithParam<Kind> {
  void SetUp() override {
    plug = plug_in(GetParam(), folder);
    ASSERT_TRUE(plug->attached());
    ASSERT_TRUE(await_node());
    server = hosting("devices", {"--listen", "127.0.0.1:0"});
    log = std::jthread([this](std::stop_token stop) {
      for (; !stop.stop_requested(); std::this_thread::sleep_for(20ms)) note_orders();
    });
    address = address_of(server);
    ASSERT_FALSE(address.empty()) << server.err();
    trainee = client(address, "trainee");
    trainer = join();
  }
  void TearDown() override {
    log = {};
    if (HasFailure()) std::printf("client: %s\nserver: %s%s\n", trainer.err().c_str(), server.out().c_str(), server.err().c_str());
  }
  [[nodiscard]] Process join() const { return client(address, "trainer", {}, plug->words()); }

  /// Until udev is done with the device.
  static bool await_node() {
    auto watch = hal::PlugWatch::open();
    return watch && within(20s, [&] {
             (void)(*watch)->wait(100ms);
             return !(*watch)->present().empty();
           });
  }
  void note_orders() {
    const std::lock_guard hold(mutex);
    for (const Order& order : plug->take()) orders.push_back(order);
  }
  /// Forgets all that was ordered so far.
  void begin_anew() {
    note_orders();
    const std::lock_guard hold(mutex);
    orders.clear();
  }
  std::vector<Order> seen() {
    note_orders();
    const std::lock_guard hold(mutex);
    return orders;
  }
  /// Into the block until the motors push back.
  void press(Process& who) {
    ASSERT_TRUE(who.wait_for("the session runs"));
    plug->carry();
    std::this_thread::sleep_for(1s);
    for (double x = 0; x < 0.05 && plug->force() < kContact; x += 0.0001) {
      plug->hold(x);
      std::this_thread::sleep_for(1ms);
    }
    std::this_thread::sleep_for(50ms);
    ASSERT_GT(plug->force(), kContact / 2) << "no contact";
    begin_anew();
  }
  /// Of all orders after `at`: the first without force came in time, and none with force after it.
  void expect_zeros_after(Time at, Duration limit, const char* what) {
    std::size_t forces = 0, zeros = 0;
    std::optional<Time> silent;
    Time last = at;
    for (const Order& order : seen()) {
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
    std::printf("[  guest   ] %s: %zu more orders with force, first zeros after %.2f ms, %zu of them until %.0f ms\n", what, forces,
                ms(*silent - at), zeros, ms(last - at));
  }

  Folder folder;
  std::unique_ptr<Plug> plug;
  Process server{{"/bin/true"}}, trainee{{"/bin/true"}}, trainer{{"/bin/true"}};
  std::string address;
  std::mutex mutex;
  std::vector<Order> orders;
  std::jthread log;
};

TEST_P(Contact, KilledTheDeadmanSendsZerosEndsAndANewClientBeginsWithoutForce) {
  ASSERT_NO_FATAL_FAILURE(press(trainer));
  const pid_t speaker = deadman();
  ASSERT_NE(speaker, 0);
  const Time at = plug->now();
  trainer.signal(SIGKILL);
  std::this_thread::sleep_for(250ms);
  expect_zeros_after(at, kPromised, "kill -9");
  EXPECT_EQ(plug->force(), 0);
  EXPECT_EQ(trainer.wait(), -SIGKILL);
  EXPECT_EQ(deadman(), 0) << "its process ends";

  std::this_thread::sleep_for(kSeatIsFree);
  begin_anew();
  trainer = join();  // the file is nobody's: it opens
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  std::this_thread::sleep_for(2s);
  std::size_t before_force = 0;
  for (const Order& order : seen()) {
    if (order.force) break;
    ++before_force;
  }
  const double most = plug->force();
  std::printf("[  guest   ] a new client: %zu orders without force first, %.2f N after 2 s with the hand held still\n", before_force, most);
  EXPECT_GE(before_force, 3U);
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Devices, Contact, testing::Values(Kind::kFalcon, Kind::kBoardV1, Kind::kBoardV2), [](const auto& kind) {
  return kind.param == Kind::kFalcon ? "Falcon" : kind.param == Kind::kBoardV1 ? "BoardV1" : "BoardV2";
});

}  // namespace tandem::test
