// The cost of a watching console for the server: CPU time of the shard's thread, in user space and in the kernel, with
// a console per session beside the same shard without. Rounds with and without consoles alternate in one process, and
// only their ratio is meaningful on a shared machine.
#include <poll.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "client/app/telemetry_feed.h"
#include "common/io/event_fd.h"
#include "server/console/app/feed_thread.h"
#include "server/session/connection_id.h"
#include "tests/bench/hosted_shard.h"
#include "tests/bench/scene_rows.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

constexpr double kRatioAsked = 1.03;

/// How a console's thread reads: in the socket, where each datagram wakes it, or as the gateway of browsers does. The
/// kernel's work to wake a waiting thread of the same computer counts as the sender's; a console elsewhere costs none.
enum class Reads { kWhenWoken, kAsGateway };

/// A console that watches one session, with a thread of its own.
class Console {
 public:
  /// @param number  of this join; other joins have other ids and secrets
  Console(HostedShard& host, std::size_t session, std::uint64_t number, Reads reads) {
    const SceneSpec& scene = host.session(session).scene();
    transport::SecureChannel::Params link = {
        .outgoing = transport::Direction::kToServer,
        .own_cid = static_cast<std::uint32_t>(number),
        .peer_cid = server::connection_id(static_cast<std::uint16_t>(number), static_cast<std::uint8_t>(session),
                                          kSeatsMax + 2),
        .tick = host.session(session).seat_catalogue().tick(),
        .secrets = {.cipher = transport::fastest_cipher(), .to_server = {}, .to_client = {}}};
    link.secrets.to_server.bytes.fill(static_cast<std::byte>(number));
    link.secrets.to_client.bytes.fill(static_cast<std::byte>(~number));
    client::TelemetryFeed feed({.scene = scene, .link = link, .udp = host.address(), .console = {}},
                               std::move(*io::connect_udp(host.address())));
    std::swap(link.own_cid, link.peer_cid);
    link.outgoing = transport::Direction::kToClient;
    request_.what = server::ShardRequest::What::kAdmitPeer;
    request_.peers = server::ShardRequest::Peers::kWatchers;
    request_.every_tick = false;
    request_.session = &host.session(session);
    request_.connection.link = std::make_unique<transport::SecureChannel>(link);
    while (!host.shard().post(request_)) std::this_thread::yield();
    while (host.shard().next_completed() == nullptr) std::this_thread::yield();
    if (request_.result != server::JoinResult::kAccepted) throw std::runtime_error("the shard refused the console");
    if (reads == Reads::kAsGateway)
      gateway_.emplace(std::move(feed),
                       [this](const std::shared_ptr<const console::LiveValues>& values, const std::string&) {
                         if (values) count(io::monotonic_now() - values->arrived);
                       });
    else
      thread_ = std::thread([this, own = std::move(feed)]() mutable { work(own); });
  }
  ~Console() {
    over_.signal();
    if (thread_.joinable()) thread_.join();
  }
  /// Times from the arrival of each TELEMETRY in the kernel to the thread, since the last call [ms].
  [[nodiscard]] std::vector<double> take_delays() {
    const std::lock_guard hold{lock_};
    return std::exchange(delays_ms_, {});
  }

 private:
  void count(Duration delay) {
    const std::lock_guard hold{lock_};
    delays_ms_.push_back(1e3 * seconds(delay));
  }
  void work(client::TelemetryFeed& feed) {
    while (true) {
      pollfd files[] = {{over_.get(), POLLIN, 0}, {feed.fd(), POLLIN, 0}};
      ::poll(files, 2, client::TelemetryFeed::kServeIntervalMs);
      const Time now = io::monotonic_now();
      if (files[0].revents != 0) return feed.leave(now);
      if (feed.serve(now)) count(now - feed.arrived());
    }
  }

  server::ShardRequest request_;
  io::EventFd over_;
  std::mutex lock_;
  std::vector<double> delays_ms_;
  std::thread thread_;
  std::optional<console::FeedThread> gateway_;
};

double quantile(std::vector<double> v, double share) {
  std::ranges::sort(v);
  return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
}
double median(const std::vector<double>& v) { return quantile(v, 0.5); }

void compare(std::size_t sessions, int seats, Reads reads, int rounds) {
  // Six turns of TELEMETRY and one WATCH fall into a slice. Medians of slices exclude those that other processes
  // disturbed.
  constexpr Duration kSettle = 100ms, kSlice = 6 * 17ms;
  constexpr int kSlices = 4;
  const SceneSpec scene = scene_of({"contact", "", 3, seats, kWall});
  HostedShard host{scene, sessions, false};
  host.run(500ms);
  std::vector<double> alone, seen, ratio, delays_ms;
  double client_ticks = 0;
  std::uint64_t number = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> here[2];
    for (const bool watched : {round % 2 == 0, round % 2 != 0}) {
      std::vector<std::unique_ptr<Console>> consoles;
      for (std::size_t s = 0; s < sessions && watched; ++s)
        consoles.push_back(std::make_unique<Console>(host, s, ++number, reads));
      host.run(kSettle);
      for (const auto& c : consoles) static_cast<void>(c->take_delays());
      for (int i = 0; i < kSlices; ++i) {
        const HostedShard::Spent spent = host.run(kSlice);
        here[watched ? 1 : 0].push_back(spent.ns_per_client_tick());
        client_ticks += watched ? spent.client_ticks : 0;
      }
      for (const auto& c : consoles) {
        const std::vector<double> more = c->take_delays();
        delays_ms.insert(delays_ms.end(), more.begin(), more.end());
      }
    }
    ratio.push_back(median(here[1]) / median(here[0]));
    alone.insert(alone.end(), here[0].begin(), here[0].end());
    seen.insert(seen.end(), here[1].begin(), here[1].end());
  }
  const double datagrams = static_cast<double>(delays_ms.size());
  const double each_us = 1e-3 * (median(seen) - median(alone)) * client_ticks / std::max(1.0, datagrams);
  const double wanted = 6.0 * kSlices * rounds * static_cast<double>(sessions);
  std::printf("%8zu %5d %-11s %7.0f %7.0f   %.3f   %.3f [%.3f..%.3f] %7.1f %5.2f %5.2f  %s\n", sessions, seats,
              reads == Reads::kWhenWoken ? "when woken" : "as gateway", median(alone), median(seen),
              median(seen) / median(alone), median(ratio), quantile(ratio, 0.25), quantile(ratio, 0.75), each_us,
              std::reduce(delays_ms.begin(), delays_ms.end()) / std::max(1.0, datagrams),
              delays_ms.empty() ? 0 : median(delays_ms),
              !host.settled()            ? "not all hands were engaged"
              : datagrams < 0.9 * wanted ? "the consoles got too few datagrams"
                                         : "");
  std::fflush(stdout);
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  using namespace tandem::bench;
  const int rounds = argc > 1 ? std::max(3, std::atoi(argv[1])) : 30;
  std::printf(
      "CPU time of the shard's thread per client-tick [ns], in user space and in the kernel: 3 axes, contact; one "
      "console per session\n%d rounds with and without consoles in turn: ratio of the medians of all slices (asked: at "
      "most %.2f), median and quartiles of the rounds' ratios; cost of one TELEMETRY [us]; time from its arrival to "
      "the "
      "console's thread, mean and median [ms]\n%8s %5s %-11s %7s %7s   %-7s %-21s %7s %s\n",
      rounds, kRatioAsked, "sessions", "seats", "reads", "alone", "seen", "ratio", "of a round", "each", "delay");
  for (const std::size_t sessions : {std::size_t{1}, std::size_t{4}})
    for (const int seats : {1, 2})
      for (const Reads reads : {Reads::kWhenWoken, Reads::kAsGateway}) compare(sessions, seats, reads, rounds);
  return 0;
}
