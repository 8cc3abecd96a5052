// The control plane under silent TCP connections: 64 addresses open ten connections per second each and send nothing,
// while clients join. All of 127.0.0.0/8 is this computer, so every 127.x.y.0/24 acts as a network of its own.
// Rejections are judged. The duration of joins is printed, and judged in virtual time only
// (PendingSlots.HonestJoinsAreNeverRefused...).
#include <gtest/gtest.h>

#include <deque>
#include <thread>

#include "common/base/format.h"
#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/common/auth/io/from_address.h"
#include "tests/common/base/counts.h"

namespace tandem::server::test {
namespace {

constexpr int kAttackers = 64, kPerSecond = 10;
constexpr std::size_t kHeld = 6000;  // attackers' connections at a time: for longer than any deadline

/// The default limits, without the exemption for loopback.
ControlLimits strict() {
  ControlLimits limits;
  limits.loopback_exempt = false;
  return limits;
}

/// Opens connections until its destruction.
class Attackers {
 public:
  Attackers(const io::SocketAddress& to, bool same_network)
      : to_(to), same_network_(same_network), thread_([this] { run(); }) {}
  ~Attackers() {
    end_ = true;
    thread_.join();
  }
  [[nodiscard]] std::size_t tried() const { return tried_; }

 private:
  void run() {
    std::deque<io::Fd> held;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; !end_; ++i) {
      std::this_thread::sleep_until(begin + i * 1000ms / (kAttackers * kPerSecond));
      const int who = i % kAttackers;
      held.push_back(
          silent_from(same_network_ ? format("127.0.0.%d", 100 + who) : format("127.%d.7.1", 10 + who), to_));
      ++tried_;
      if (held.size() > kHeld) held.pop_front();
    }
  }
  io::SocketAddress to_;
  bool same_network_;
  std::atomic<bool> end_{false};
  std::atomic<std::size_t> tried_{0};
  std::thread thread_;
};

struct Verdict {
  std::size_t joined = 0, refused = 0;
  std::vector<double> took;  ///< [s]
};

/// Sequential joins, ten per second, by eight workstations at 127.0.0.1.
Verdict join_under_siege(bool same_network, std::size_t joins) {
  EXPECT_GE(many_descriptors(), kHeld + 4096);
  ControlServerFixture door(strict());
  std::vector<auth::Identity> people;
  for (int i = 0; i < 8; ++i) people.push_back(door.enrolled("desk-" + std::to_string(i)));
  std::vector<auth::TicketBytes> tickets;
  for (std::size_t i = 0; i < joins; ++i)
    tickets.push_back(door.ticket(people[i % people.size()], static_cast<unsigned>(i)));
  Verdict verdict;
  {
    const Attackers attackers(door.address, same_network);
    EXPECT_TRUE(door.told(ControlEvent::kDeadline)) << "places are short: silence ends after a second";
    for (std::size_t i = 0; i < joins; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      auto client = door.connect(people[i % people.size()]);
      const auto answer = client ? client->ask(hello_with(tickets[i]), kTimeout) : std::unexpected(client.error());
      const auto end = std::chrono::steady_clock::now();
      if (answer && std::holds_alternative<rpc::Welcome>(*answer)) {
        ++verdict.joined;
        verdict.took.push_back(std::chrono::duration<double>(end - begin).count());
      } else {
        ++verdict.refused;
        std::printf("[ hostile  ] join %zu: %s\n", i, answer ? "refused" : answer.error().text.c_str());
      }
      std::this_thread::sleep_until(begin + 100ms);
    }
    std::ranges::sort(verdict.took);
    std::printf(
        "[ hostile  ] %zu of %zu joins accepted while 64 addresses of %s network opened %zu silent connections (%llu "
        "accepted, %llu evicted, %llu too slow); "
        "each took %.3f s (median), at most %.3f s\n",
        verdict.joined, joins, same_network ? "the same" : "other", attackers.tried(),
        static_cast<unsigned long long>(door.plane->count(ControlEvent::kAccepted)),
        static_cast<unsigned long long>(door.plane->count(ControlEvent::kEvicted)),
        static_cast<unsigned long long>(door.plane->count(ControlEvent::kDeadline)),
        verdict.took.empty() ? 0.0 : verdict.took[verdict.took.size() / 2],
        verdict.took.empty() ? 0.0 : verdict.took.back());
    EXPECT_GT(door.plane->count(ControlEvent::kAccepted), attackers.tried() / 2) << "the attack reached the server";
  }
  return verdict;
}

TEST(ConnectionFlood, RejectsNoJoinForSilentConnectionsOfOtherNetworks) {
  const std::size_t joins = tandem::test::draws(20, 100, 100);
  const Verdict verdict = join_under_siege(false, joins);
  EXPECT_EQ(verdict.refused, 0u);
  EXPECT_EQ(verdict.joined, joins);
}

TEST(ConnectionFlood, RejectsAtMostOneJoinInTenForSilentOnesOfTheSameNetwork) {
  const std::size_t joins = tandem::test::draws(20, 100, 100);
  const Verdict verdict = join_under_siege(true, joins);
  EXPECT_LE(verdict.refused, joins / 10);
}

}  // namespace
}  // namespace tandem::server::test
