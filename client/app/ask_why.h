#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "common/io/fd.h"
#include "common/trust/io/control_client.h"
#include "proto/control_messages.h"

namespace tandem::client {

/// Asks the server, on a thread of its own, who stopped the session and why: FORCE says only that it is stopped. The hand waits for
/// nothing of it; a connection that is gone gives no answer, and the seat lives on.
class AskWhy {
 public:
  /// Begins. @param connection  of the joining; nobody else uses it meanwhile. Null: there is no answer
  AskWhy(std::shared_ptr<trust::ControlClient> connection, const control::Id& session);
  ~AskWhy();
  AskWhy(const AskWhy&) = delete;
  AskWhy& operator=(const AskWhy&) = delete;

  [[nodiscard]] bool done() const noexcept { return done_.load(std::memory_order_acquire); }
  /// Readable once it is.
  [[nodiscard]] int done_fd() const noexcept { return done_event_.get(); }
  /// One line for a person: who, why, and who may end it. Empty: nobody answered. @pre done()
  [[nodiscard]] const std::string& answer() const noexcept { return answer_; }

 private:
  std::shared_ptr<trust::ControlClient> connection_;
  io::Fd done_event_;
  std::string answer_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

/// Why a seat is not his any more, from whoever took it; empty: nobody says. Waits for the answer, not long.
[[nodiscard]] std::string ask_why_gone(trust::ControlClient* connection, const control::Id& session);

}  // namespace tandem::client
