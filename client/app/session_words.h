#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/io/fd.h"
#include "common/trust/io/control_client.h"
#include "proto/control_messages.h"

namespace tandem::client {

/// Asks the server once a second, on a thread of its own, how the session stands: who leads, who stopped it and why, how far a drain is. FORCE
/// carries numbers only. The hand waits for nothing of it. A connection that is gone gives no more answers, and the seat lives on.
class SessionWords {
 public:
  static constexpr std::chrono::milliseconds kPatience{2000};
  /// Begins. @param connection  of the joining; nobody else uses it until this object is gone. Null: there are no answers
  /// @param patience  for each answer
  SessionWords(std::shared_ptr<trust::ControlClient> connection, const control::Id& session, std::chrono::milliseconds patience = kPatience);
  /// Waits for an answer that is under way, for the patience at most.
  ~SessionWords();
  SessionWords(const SessionWords&) = delete;
  SessionWords& operator=(const SessionWords&) = delete;

  /// Ends the connection, which nobody needs any more: the destructor then waits for no answer.
  void give_up() noexcept;
  /// Something changed: asks now instead of within a second.
  void hurry() noexcept;
  /// Readable when there is something to take.
  [[nodiscard]] int news_fd() const noexcept { return news_.get(); }
  /// The connection is gone: nothing new comes, and what was said before may be wrong by now.
  [[nodiscard]] bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  /// The newest answer that was not taken yet.
  [[nodiscard]] std::optional<control::Status> take();

 private:
  void work(const control::Id& session);

  std::shared_ptr<trust::ControlClient> connection_;
  std::chrono::milliseconds patience_;
  io::Fd socket_;  ///< a duplicate of the connection's: the thread may close that one at any time
  io::Fd news_, wake_;
  std::mutex lock_;
  std::optional<control::Status> newest_;
  std::atomic<bool> over_{false}, ended_{false};
  std::thread thread_;
};

/// Why a seat was taken away, in the words of the server; empty: it does not say. Waits for the answer, 2 s at most.
[[nodiscard]] std::string ask_why_gone(trust::ControlClient* connection, const control::Id& session);

}  // namespace tandem::client
