#include "server/app/service/service_thread.h"

#include <chrono>
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
  {
    const std::lock_guard lock(wake_mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void ServiceThread::wake() {
  {
    const std::lock_guard lock(wake_mutex_);
    woken_ = true;
  }
  wake_.notify_one();
}

void ServiceThread::run() {
  while (true) {
    auto newest = snapshots_.take();
    std::vector<ServiceTickets::Result> results;
    auto pause = kPause;
    {
      const std::lock_guard lock(mutex_);
      for (auto& news : newest) {
        if (!news.snapshot.empty()) member_.set_snapshot(news.session, std::move(news.snapshot));
        if (news.consoles) member_.set_consoles(news.session, std::move(*news.consoles));
      }
      member_.step(now());
      while (const auto result = member_.tickets().poll_result()) results.push_back(*result);
      if (member_.has_event() || std::exchange(acted_until_, member_.act_until()) != member_.act_until())
        changed_.signal();
      if (member_.calm()) pause = kCalmPause;
    }
    for (const ServiceTickets::Result& result : results) on_ticket_(result);
    std::unique_lock lock(wake_mutex_);
    wake_.wait_for(lock, pause, [this] { return woken_ || stopping_; });
    woken_ = false;
    if (stopping_) return;
  }
}

std::optional<ServiceEvent> ServiceThread::take_event() {
  const std::lock_guard lock(mutex_);
  return member_.poll_event();
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
