#include "server/console/app/feed_thread.h"

#include <poll.h>

#include <algorithm>
#include <utility>

#include "common/io/clock.h"

namespace tandem::console {
namespace {

using namespace std::chrono_literals;

constexpr Duration kSilence = 3s;        // until the page hears that no datagrams arrive
constexpr Duration kLeastPeriod = 14ms;  // a recorder's connection gets every tick, which no screen needs

std::shared_ptr<const LiveValues> values_of(const client::TelemetryFeed& feed, ToolVelocities& velocities) {
  const client::SessionWatch& watch = feed.watch();
  auto values = std::make_shared<LiveValues>();
  values->telemetry = *watch.newest();
  values->arrived = feed.arrived();
  values->velocities = velocities.update(values->telemetry, feed.scene().tick_hz);
  for (std::size_t i = 0; i < feed.scene().seats.size(); ++i) values->links[i] = watch.link_of(i);
  for (std::size_t j = 0; j < feed.scene().tools.size(); ++j) values->authorities[j] = watch.authority_over(j);
  return values;
}

std::string text_of(wire::CloseReason why) {
  switch (why) {
    case wire::CloseReason::kServerReturns:
      return "the server is being restarted, so no live values come";
    case wire::CloseReason::kRevoked:
    case wire::CloseReason::kRemoved:
      return "the server withdrew the right to watch; ask its operator" + std::string(kStatusOnly);
    default:
      return "the session is over" + std::string(kStatusOnly);
  }
}

}  // namespace

FeedThread::FeedThread(client::TelemetryFeed feed, Sink sink)
    : feed_(std::move(feed)), sink_(std::move(sink)), thread_([this] { work(); }) {}

FeedThread::~FeedThread() {
  over_.signal();
  thread_.join();
}

void FeedThread::work() {
  Time published{}, now{};
  ToolVelocities velocities;
  bool pending = false, silent = false;
  while (true) {
    now = io::monotonic_now();
    const client::ReadPace::Wait wait = feed_.next_wait(now);
    pollfd files[] = {{over_.get(), POLLIN, 0}, {feed_.fd(), POLLIN, 0}};
    const timespec longest =
        io::to_timespec(pending ? std::min(wait.longest, published + kLeastPeriod - now) : wait.longest);
    ::ppoll(files, wait.for_datagram ? 2 : 1, &longest, nullptr);
    now = io::monotonic_now();
    if (files[0].revents != 0) return feed_.leave(now);
    pending = feed_.serve(now) || pending;
    if (const auto why = feed_.watch().closed()) return sink_(nullptr, text_of(*why));
    if (pending && now - published >= kLeastPeriod) {
      published = now;
      pending = silent = false;
      sink_(values_of(feed_, velocities), {});
    } else if (!silent && feed_.watch().silence(now) > kSilence) {
      silent = true;
      sink_(nullptr,
            (feed_.watch().newest()
                 ? "no datagram of the server arrived for 3 s"
                 : "the server accepted the join, but no datagram arrives; a firewall may block UDP. `tandem-client "
                   "link-test` judges the link") +
                std::string(kStatusOnly));
    }
  }
}

}  // namespace tandem::console
