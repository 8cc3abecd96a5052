#pragma once

#include <atomic>
#include <expected>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "client/app/join_client.h"
#include "client/app/seat_runner.h"
#include "common/io/event_fd.h"
#include "common/io/fd.h"

namespace tandem::client {

/// Reconnects a seat to a silent server on its own thread. It retries until the server returns the seat, rejects it
/// permanently, or answers on the old connection again. It also ends when the servers of a service have answered for
/// long enough that they do not have the session (`MissingSession`). Meanwhile the servo thread runs on; its force gate
/// has released the force and the motors receive zeros.
class Reconnector {
 public:
  /// Starts the thread.
  /// @param asking      options of the join; the Reconnector sets its own timeout and signals
  /// @param seat, runner  must outlive this object
  /// @param kept        the socket in use. It is reused while this host has the same address, so that a NAT or the
  ///                    netsim proxy recognises the client.
  Reconnector(JoinOptions asking, ResumeState own, const Seat& seat, const SeatRunner& runner,
              const io::UdpSocket& kept);
  /// Cancels the attempt and waits for its end. A seat that was resumed but not taken is released at the server.
  ~Reconnector();
  Reconnector(const Reconnector&) = delete;
  Reconnector& operator=(const Reconnector&) = delete;

  /// Cancels the attempt. Does not wait.
  void cancel() const noexcept {
    if (!done()) cancel_.signal();  // once done, the signal would disturb the connection in the result
  }
  [[nodiscard]] bool done() const noexcept { return done_.load(std::memory_order_acquire); }
  /// Readable once `done()`.
  [[nodiscard]] int done_fd() const noexcept { return done_event_.get(); }
  /// Returns why the client rejects the key of a server that answered to the newest attempt, for any thread; empty: it
  /// rejects none. The Reconnector tries again, because another server may get the session.
  [[nodiscard]] std::string distrust() const {
    const std::lock_guard lock(mutex_);
    return distrust_;
  }
  /// Returns why a server did not give the seat back, in the newest attempt that reached one, for any thread; empty:
  /// none was reached.
  [[nodiscard]] std::string answer() const {
    const std::lock_guard lock(mutex_);
    return answer_;
  }
  struct Resumed {
    JoinedSeat joined;
    std::unique_ptr<ConnectionSwap> swap;
  };
  /// Returns the result. Call once. @pre done()
  [[nodiscard]] std::expected<Resumed, ResumeError> take() { return std::move(*result_); }

 private:
  void work();
  [[nodiscard]] std::expected<Resumed, ResumeError> attempt(Duration timeout);

  JoinOptions options_;
  ResumeState resume_state_;
  const Seat* seat_;
  const SeatRunner* runner_;
  const io::UdpSocket* socket_;
  io::EventFd cancel_, done_event_;
  std::optional<std::expected<Resumed, ResumeError>> result_;
  std::atomic<bool> done_{false};
  mutable std::mutex mutex_;
  std::string distrust_, answer_;
  std::thread thread_;
};

/// Returns the randomised silence of the server before a client reconnects, 1 s to 1.5 s. Short outages then need no
/// reconnect, and many clients do not reconnect at the same time.
[[nodiscard]] Duration initial_backoff();
/// The same after a server of a service has ended its part in the session, 0.3 s to 0.5 s.
[[nodiscard]] Duration hastened_backoff();

}  // namespace tandem::client
