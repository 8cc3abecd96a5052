// The order of load shedding, live: a server's own thread and socket, with more and more sessions until its ticks are
// full.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "common/io/clock.h"
#include "server/app/process/shard.h"
#include "tests/bench/bench_clients.h"
#include "tests/io/machine_witness.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;
using server::ShedLevel;

constexpr std::size_t kTrainee = 0, kEvaluator = 1, kObserver = 7;
constexpr Duration kTimeout = 60s;  // limit against hanging, never judged
constexpr double kTickHz = 8000;

/// A trainee, six evaluators and an observer.
SceneSpec watched() {
  SceneSpec scene = test::shipped("eight_seats");
  scene.tick_hz = kTickHz;
  scene.duration = 600;
  scene.seats[kObserver].role = Role::kObserver;
  return scene;
}

/// Sessions with and without clients, on one tick thread.
class Crowded {
 public:
  Crowded()
      : shard_(
            std::make_unique<server::Shard>(std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0))), kTickHz)) {
    host(scene_);
    for (std::size_t i = 0; i < scene_.seats.size(); ++i) {
      clients_.push_back(std::make_unique<BareClient>(*netsim::simulate_join(
          hosted_[0]->session(), io::monotonic_now(), i, caps_of(scene_, i), RandomKey{1}, i, false, 0)));
      sockets_.push_back(std::move(io::connect_udp(shard_->address())->fd));
    }
    thread_ = std::thread([this] { shard_->run(); });
  }
  ~Crowded() {
    shard_->stop();
    thread_.join();
  }
  Crowded(const Crowded&) = delete;
  Crowded& operator=(const Crowded&) = delete;

  /// Adds a session whose arms are simulated in every tick.
  void add_work() { host(work_); }
  [[nodiscard]] std::size_t sessions() const { return hosted_.size(); }

  /// Every client sends its position and receives.
  void exchange() {
    std::array<std::byte, 1500> buffer;
    ++tick_;
    for (std::size_t c = 0; c < clients_.size(); ++c) {
      for (ssize_t size; (size = ::recv(sockets_[c].get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
        clients_[c]->hear(io::monotonic_now(), std::span{buffer}.first(static_cast<std::size_t>(size)));
      for (bool more = true; more;) {
        more = clients_[c]->answers();
        const std::size_t size = clients_[c]->send(io::monotonic_now(), tick_, buffer);
        if (size > 0) [[maybe_unused]]
          const auto sent = ::send(sockets_[c].get(), buffer.data(), size, 0);
      }
    }
  }
  [[nodiscard]] ShedLevel rung() const { return shard_->load().state().level; }
  /// Number of datagrams that the server has sent to a client, as the counter of the newest one says.
  [[nodiscard]] std::uint64_t sent(std::size_t client) const { return clients_[client]->counter(); }
  [[nodiscard]] bool engaged() const { return clients_[kTrainee]->settled() && clients_[kEvaluator]->settled(); }

 private:
  void host(const SceneSpec& scene) {
    queues_.push_back(std::make_unique<server::TickQueue>(
        64));  // soon full: its records are dropped and counted, as with a late recorder
    hosted_.push_back(std::make_unique<server::LiveSession>(
        scene, *server::make_local_slaves(scene, Time{}), static_cast<std::uint8_t>(hosted_.size()), *queues_.back()));
    orders_.push_back(std::make_unique<server::ShardRequest>());
    orders_.back()->what = server::ShardRequest::What::kAddSession;
    orders_.back()->session = hosted_.back().get();
    EXPECT_TRUE(shard_->post(*orders_.back()));
    while (shard_->next_completed() != nullptr) {
    }
  }

  SceneSpec scene_ = watched(), work_ = [] {
    SceneSpec scene = test::shipped("eight_seats");
    scene.tick_hz = kTickHz;
    return scene;
  }();
  std::unique_ptr<server::Shard> shard_;
  std::vector<std::unique_ptr<server::TickQueue>> queues_;
  std::vector<std::unique_ptr<server::LiveSession>> hosted_;
  std::vector<std::unique_ptr<server::ShardRequest>> orders_;
  std::vector<std::unique_ptr<BareClient>> clients_;
  std::vector<io::Fd> sockets_;
  std::thread thread_;
  std::uint32_t tick_ = 0;
};

/// Datagrams sent at one shed level. All are FORCEs, except for a few path challenges.
struct Sent {
  std::array<std::uint64_t, 8> datagrams{};
  [[nodiscard]] double share(std::size_t client) const {
    return static_cast<double>(datagrams[client]) / static_cast<double>(datagrams[kTrainee]);
  }
};

/// Adds sessions until all load is shed. @return whether the order and the shares could be judged
bool raise_all_levels() {
  const tandem::test::MachineWitness witness;
  Crowded crowd;
  const Time begin = io::monotonic_now();
  while (!crowd.engaged() && io::monotonic_now() - begin < kTimeout) {
    crowd.exchange();
    std::this_thread::sleep_for(500us);
  }
  EXPECT_TRUE(crowd.engaged());
  if (!crowd.engaged()) return true;
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  if (crowd.rung() != ShedLevel::kNone) {
    std::printf(
        "[ NOT RUN ] under this sanitizer one session fills the ticks already; a release build climbs all rungs\n");
    return true;
  }
#endif

  std::vector<ShedLevel> order{ShedLevel::kNone};
  std::array<Sent, server::kShedLevels> sent{};
  std::array<std::uint64_t, 8> before{};
  for (std::size_t c = 0; c < before.size(); ++c) before[c] = crowd.sent(c);
  std::array<std::size_t, server::kShedLevels> sessions{};
  Time grown = io::monotonic_now(), reached = grown;
  // The last level runs for half a second, so that its shares are measured too.
  while (io::monotonic_now() - begin < kTimeout &&
         !(order.back() == ShedLevel::kNewJoins && io::monotonic_now() - reached > 500ms)) {
    crowd.exchange();
    const ShedLevel now = crowd.rung();
    for (std::size_t c = 0; c < before.size(); ++c) {
      // Datagrams that were in flight when a level was reached count for no level.
      if (io::monotonic_now() - reached > 40ms)
        sent[static_cast<std::size_t>(now)].datagrams[c] += crowd.sent(c) - before[c];
      before[c] = crowd.sent(c);
    }
    if (now != order.back()) {
      order.push_back(now);
      reached = io::monotonic_now();
    }
    sessions[static_cast<std::size_t>(now)] = crowd.sessions();
    // Several windows of the shedder at every level, so that its effect shows before more load is added.
    const bool settled = now == ShedLevel::kNone || io::monotonic_now() - reached > 350ms;
    if (now != ShedLevel::kNewJoins && io::monotonic_now() - grown > 50ms && settled &&
        crowd.sessions() < server::Shard::kSessionsMax) {
      crowd.add_work();
      grown = io::monotonic_now();
    }
    std::this_thread::sleep_for(400us);
  }

  for (std::size_t r = 0; r < server::kShedLevels; ++r)
    std::printf(
        "[  shed    ] %-27s at %2zu sessions: %5llu FORCEs to the trainee, %.3f of that to an evaluator, %.4f to the "
        "observer\n",
        to_text(static_cast<ShedLevel>(r)), sessions[r], static_cast<unsigned long long>(sent[r].datagrams[kTrainee]),
        sent[r].share(kEvaluator), sent[r].share(kObserver));
  const std::vector<ShedLevel> expected{
      ShedLevel::kNone,          ShedLevel::kTelemetry,          ShedLevel::kObservers20Hz,
      ShedLevel::kObservers10Hz, ShedLevel::kEvaluatorsEvery2nd, ShedLevel::kEvaluatorsEvery3rd,
      ShedLevel::kNewJoins};
  EXPECT_EQ(order.back(), ShedLevel::kNewJoins) << "the whole load is shed in the end";
  EXPECT_TRUE(std::ranges::is_sorted(order)) << "no level falls while the load grows";
  // A machine that stands still skips levels between two looks, and takes ticks from their counts.
  if (witness.machine_stood_still()) return false;
  EXPECT_EQ(order, expected) << "one after the other";
  if (order != expected) return true;
  const auto of = [&](ShedLevel rung) -> const Sent& { return sent[static_cast<std::size_t>(rung)]; };
  for (const ShedLevel rung : expected) {
    SCOPED_TRACE(to_text(rung));
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
    if (rung == ShedLevel::kNone && of(rung).datagrams[kTrainee] <= 100U)
      continue;  // one session filled the ticks before the count began
#endif
    EXPECT_GT(of(rung).datagrams[kTrainee], 100U);
    // Every tick, every 2nd, every 3rd.
    const double share = rung < ShedLevel::kEvaluatorsEvery2nd    ? 1.0
                         : rung == ShedLevel::kEvaluatorsEvery2nd ? 1.0 / 2
                                                                  : 1.0 / 3;
    EXPECT_NEAR(of(rung).share(kEvaluator), share, 0.1 * share);
    const double observer = (rung < ShedLevel::kObservers20Hz    ? 60
                             : rung == ShedLevel::kObservers20Hz ? 20
                                                                 : 10) /
                            kTickHz;
    EXPECT_LT(of(rung).share(kObserver), 1.5 * observer + 4.0 / static_cast<double>(of(rung).datagrams[kTrainee]));
  }
  return true;
}

TEST(ShedOrderLive, RaisesTheLevelInOrderAndServesTheTraineeEveryTick) {
  tandem::test::repeat_disturbed("the order of load shedding", raise_all_levels);
}

}  // namespace
}  // namespace tandem::bench
