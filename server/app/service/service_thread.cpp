#include "server/app/service/service_thread.h"

#include <poll.h>

#include <chrono>
#include <iterator>
#include <utility>

#include "common/io/clock.h"
#include "common/io/thread_without_signals.h"

namespace tandem::server {
namespace {

/// Longest time between two rounds; an answer of the directory begins one at once. A round takes some 40 us of a
/// processor, so that there are fewer while nothing happens.
constexpr auto kPause = std::chrono::milliseconds(20), kCalmPause = std::chrono::milliseconds(50);
constexpr auto kLook = std::chrono::milliseconds(5);  // between two looks, at the end of the server

}  // namespace

ServiceThread::ServiceThread(ServiceMemberOptions options, std::unique_ptr<directory::Directory> store,
                             DirectorySnapshots& snapshots)
    : store_(std::move(store)), snapshots_(snapshots), member_(std::move(options), *store_) {}

Time ServiceThread::now() noexcept { return Time{io::read_clock(CLOCK_BOOTTIME)}; }

void ServiceThread::start(std::function<void(const ServiceTickets::Result&)> on_ticket) {
  on_ticket_ = std::move(on_ticket);
  store_->notify_by([this] { wake(); });
  thread_ = io::thread_without_signals([this] { run(); });
}

void ServiceThread::stop() {
  if (!thread_.joinable()) return;
  store_->notify_by({});
  stopping_ = true;
  wake();
  thread_.join();
}

void ServiceThread::wait(std::chrono::milliseconds longest) {
  pollfd files[] = {{wake_.get(), POLLIN, 0}, {snapshots_.order_fd(), POLLIN, 0}};
  poll(files, std::size(files), static_cast<int>(longest.count()));
  wake_.clear();  // before the round, which does what it was signalled for
}

void ServiceThread::run() {
  while (!stopping_) {
    auto newest = snapshots_.take(now());
    std::vector<ServiceTickets::Result> results;
    auto pause = kPause;
    {
      const std::lock_guard lock(mutex_);
      for (auto& news : newest) {
        if (!news.snapshot.empty())
          member_.sessions().set_snapshot(news.session, std::move(news.snapshot), news.mark, news.order);
        if (news.consoles) member_.sessions().set_consoles(news.session, std::move(*news.consoles));
      }
      member_.step(now());
      while (const auto result = member_.tickets().poll_result()) results.push_back(*result);
      while (const auto mark = member_.poll_stored()) snapshots_.set_stored(*mark);
      snapshots_.set_problem(member_.storage_problem());
      if (const auto until = member_.served_until()) act_limit_->set(*until);
      if (member_.sessions().has_event()) changed_.signal();
      if (member_.calm()) pause = kCalmPause;
    }
    for (const ServiceTickets::Result& result : results) on_ticket_(result);
    wait(pause);
  }
}

std::optional<ServiceEvent> ServiceThread::take_event() {
  const std::lock_guard lock(mutex_);
  return member_.sessions().poll_event();
}

bool ServiceThread::wait_for(Duration limit, const std::function<bool(const ServiceMember&)>& done) {
  for (const Time end = now() + limit; now() < end; std::this_thread::sleep_for(kLook)) {
    const std::lock_guard lock(mutex_);
    if (done(member_)) return true;
  }
  return false;
}

bool ServiceThread::leave(Duration limit) {
  if (!thread_.joinable()) return false;
  // The thread has taken all mailboxes after one whole round.
  wake();
  std::this_thread::sleep_for(2 * kPause);
  static_cast<void>(wait_for(limit, [](const ServiceMember& member) { return member.all_written(); }));
  with([](ServiceMember& member, Time) { member.leave(); });
  return wait_for(limit, [](const ServiceMember& member) { return member.left(); });
}

}  // namespace tandem::server
