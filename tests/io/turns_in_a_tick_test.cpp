// Sessions of one tick thread get their turn one after another; each acts on what arrived until its own turn.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "common/io/udp_socket.h"
#include "tests/bench/hosted_shard.h"
#include "tests/bench/seated_shard.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

/// Returns the time of each recorded tick of a session since its first one [ns], by the number of the tick.
std::map<std::uint32_t, std::int64_t> times_of(server::TickQueue& records) {
  std::map<std::uint32_t, std::int64_t> times;
  for (const server::TickRecord* record = nullptr; (record = records.front()) != nullptr; records.pop())
    times[record->tick] = record->time_ns;
  return times;
}

#ifdef __SANITIZE_THREAD__
constexpr bool kSlow = true;
#else
constexpr bool kSlow = false;
#endif
constexpr const char* kTooSlow = "under the thread sanitizer 20 sessions do not get their turns within a tick";

TEST(TurnsInATick, HaveATimeOfTheirOwn) {
  if (kSlow) GTEST_SKIP() << kTooSlow;
  const SceneSpec scene = test::shipped("contact_remote");
  HostedShard host{scene, 20, true};  // 60 hands: the datagrams of 10 sessions fill half a batch
  host.run(500ms);
  ASSERT_TRUE(host.settled());
  const auto first = times_of(host.records(0)), last = times_of(host.records(19));
  int common = 0, later = 0;
  for (const auto& [tick, time] : first) {
    const auto same = last.find(tick);
    if (same == last.end()) continue;
    ++common;
    later += same->second != time ? 1 : 0;
  }
  ASSERT_GT(common, 10);
  EXPECT_GT(later, common / 2) << "the last session has the time of the first one";
}

/// Contact source that finds no surface. The session calls it in each of its turns, on the shard's thread.
class AtEachTurn final : public server::ContactSource {
 public:
  explicit AtEachTurn(std::function<void()> act) : act_(std::move(act)) {}
  void find_contacts(const server::ToolView&, LocalContactList&) noexcept override { act_(); }

 private:
  std::function<void()> act_;
};

/// A shard whose clients all send a STATE in the first session's turn, when the tick has read its socket already. It
/// counts the turns of the first and of the last session in which all STATEs of the session's first hand so far have
/// taken effect.
class SendingWithinTheTick {
 public:
  static constexpr std::size_t kSessions = 24;  ///< of 2 hands: the datagrams of 16 sessions fill half a batch
  static constexpr int kTicks = 400;
  struct Turns {
    int all = 0;    ///< turns with a STATE that was sent in this tick
    int fresh = 0;  ///< of these: turns in which it has taken effect
  };

  SendingWithinTheTick() {
    for (std::size_t c = 0; c < seated_.clients().size(); ++c)
      sockets_.push_back(std::move(io::connect_udp(seated_.address())->fd));
    at_turn_of(0, [this] {
      if (++ticks_ > kTicks) return seated_.shard().stop();
      send_all();
      note(0, first_);
    });
    at_turn_of(kSessions - 1, [this] {
      note(kSessions - 1, last_);
      sent_in_tick_.assign(sent_in_tick_.size(), false);
    });
    std::thread{[this] { seated_.shard().run(); }}.join();
  }

  [[nodiscard]] const Turns& first() const { return first_; }
  [[nodiscard]] const Turns& last() const { return last_; }

 private:
  void at_turn_of(std::size_t session, std::function<void()> act) {
    if (!seated_.session(session).session().set_contact_source(0, std::make_unique<AtEachTurn>(std::move(act))))
      throw std::logic_error("the scene has no tool that meets surfaces itself");
  }
  void send_all() {
    std::array<std::byte, 1500> buffer;
    for (std::size_t c = 0; c < sockets_.size(); ++c) {
      BareClient& client = *seated_.clients()[c];
      for (ssize_t size; (size = ::recv(sockets_[c].get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
        client.hear(io::monotonic_now(), std::span{buffer}.first(static_cast<std::size_t>(size)));
      while (client.answers()) send(c, buffer);
      send(c, buffer);
      ++states_[c];
      sent_in_tick_[c] = true;
    }
  }
  void send(std::size_t c, std::span<std::byte> buffer) {
    const std::size_t size =
        seated_.clients()[c]->send(io::monotonic_now(), static_cast<std::uint32_t>(ticks_), buffer);
    [[maybe_unused]] const auto sent = ::send(sockets_[c].get(), buffer.data(), size, 0);
  }
  void note(std::size_t session, Turns& turns) {
    const std::size_t c = session * kHands;
    if (!sent_in_tick_[c] || !seated_.clients()[c]->settled()) return;
    ++turns.all;
    turns.fresh += seated_.session(session).session().seat(0).generation() == states_[c] ? 1 : 0;
  }

  static constexpr std::size_t kHands = 2;
  SceneSpec scene_ = test::shipped("contact");
  SeatedShard seated_{scene_, kSessions, false};
  std::vector<io::Fd> sockets_;
  std::vector<std::uint64_t> states_ = std::vector<std::uint64_t>(kSessions * kHands);  ///< sent so far, by client
  std::vector<bool> sent_in_tick_ = std::vector<bool>(kSessions * kHands);
  int ticks_ = 0;
  Turns first_, last_;
};

TEST(TurnsInATick, ActOnStatesThatArriveWithinTheTick) {
  if (kSlow) GTEST_SKIP() << kTooSlow;
  const SendingWithinTheTick run;
  ASSERT_GT(run.first().all, SendingWithinTheTick::kTicks / 2);
  ASSERT_GT(run.last().all, SendingWithinTheTick::kTicks / 2);
  EXPECT_EQ(run.first().fresh, 0) << "a STATE took effect in the turn in which it was sent: the test proves nothing";
  EXPECT_GT(run.last().fresh, run.last().all / 2) << "the last session has what was there before the first turn";
}

}  // namespace
}  // namespace tandem::bench
