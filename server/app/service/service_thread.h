#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "common/io/event_fd.h"
#include "server/app/process/act_limit.h"
#include "server/app/service/directory_snapshots.h"
#include "server/service/service_member.h"

namespace tandem::server {

/// Runs a member of a service on a thread of its own, so that neither the main loop nor a control connection delays a
/// renewal. The clock is CLOCK_BOOTTIME, which goes on while the machine is suspended.
class ServiceThread {
 public:
  /// @param snapshots  of the sessions of this server; must outlive this
  ServiceThread(ServiceMemberOptions options, std::unique_ptr<directory::Directory> store,
                DirectorySnapshots& snapshots);
  ~ServiceThread() { stop(); }

  /// @param on_ticket  receives results of tickets on this thread
  void start(std::function<void(const ServiceTickets::Result&)> on_ticket);
  void stop();

  /// Calls `act` with the member and the time, from any thread but that of a tick, and has its operations begin.
  template <class Act>
  auto with(Act&& act) {
    const Wake wake(*this);
    const std::lock_guard lock(mutex_);
    return std::forward<Act>(act)(member_, now());
  }
  /// The same for reading, and for changes that may wait: no operation begins earlier because of it.
  template <class Act>
  auto quietly(Act&& act) {
    const std::lock_guard lock(mutex_);
    return std::forward<Act>(act)(member_, now());
  }
  /// Next order of the member. From the main loop's thread.
  [[nodiscard]] std::optional<ServiceEvent> take_event();
  /// For all sessions of this server: set by this thread, also while the main loop waits for a disk.
  [[nodiscard]] std::shared_ptr<const ActLimit> act_limit() const noexcept { return act_limit_; }
  /// Descriptor that is readable while an order waits.
  [[nodiscard]] int fd() const noexcept { return changed_.get(); }
  void clear_fd() const noexcept { changed_.clear(); }
  /// Ends all ownerships, for the end of the server: writes the last snapshots and ends the lease, for at most `limit`
  /// each. No session may have effort any more. @return whether the directory confirmed it
  bool leave(Duration limit);

  /// Time of CLOCK_BOOTTIME.
  [[nodiscard]] static Time now() noexcept;

 private:
  /// Wakes the thread when it is destroyed, after the lock is free.
  struct Wake {
    explicit Wake(ServiceThread& of) noexcept : thread(&of) {}
    ~Wake() { thread->wake(); }
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;
    ServiceThread* thread;
  };
  void wake() { wake_.signal(); }
  void run();
  /// Waits for a reason for another round, at most `longest`.
  void wait(std::chrono::milliseconds longest);
  bool wait_for(Duration limit, const std::function<bool(const ServiceMember&)>& done);

  std::unique_ptr<directory::Directory> store_;
  std::function<void(const ServiceTickets::Result&)> on_ticket_;
  DirectorySnapshots& snapshots_;
  std::mutex mutex_;  ///< guards `member_`
  ServiceMember member_;
  std::shared_ptr<ActLimit> act_limit_ = std::make_shared<ActLimit>();
  io::EventFd changed_;
  io::EventFd wake_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace tandem::server
