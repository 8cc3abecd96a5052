#include "client/app/session_status_poller.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdint>
#include <utility>

#include "common/base/sanitize.h"

namespace tandem::client {
namespace {

constexpr int kEveryMs = 1000;
constexpr int kLeastMs = 150;  // pause between two requests, because a server answers ten per second

}  // namespace

SessionStatusPoller::SessionStatusPoller(std::shared_ptr<auth::ControlClient> connection, const rpc::Id& session,
                                         std::chrono::milliseconds reply_timeout)
    : connection_(std::move(connection)),
      reply_timeout_(reply_timeout),
      socket_(connection_ ? ::fcntl(connection_->fd(), F_DUPFD_CLOEXEC, 0) : -1) {
  if (connection_) thread_ = std::thread([this, session] { work(session); });
}

SessionStatusPoller::~SessionStatusPoller() {
  over_.store(true, std::memory_order_relaxed);
  poll_now();
  if (thread_.joinable()) thread_.join();
}

void SessionStatusPoller::cancel() noexcept { ::shutdown(socket_.get(), SHUT_RDWR); }

void SessionStatusPoller::poll_now() noexcept { wake_.signal(); }

std::optional<rpc::Status> SessionStatusPoller::take() {
  news_.clear();
  const std::lock_guard lock{lock_};
  return std::exchange(newest_, std::nullopt);
}

void SessionStatusPoller::work(const rpc::Id& session) {
  while (!over_.load(std::memory_order_relaxed)) {
    auto answer = connection_->ask(rpc::StatusRequest{session}, reply_timeout_);
    // A session that moved has a status at its new server only; the reconnect of the seat finds it.
    if (!answer || std::holds_alternative<rpc::Elsewhere>(*answer)) {
      ended_.store(true, std::memory_order_release);
      return;
    }
    if (auto* status = std::get_if<rpc::Status>(&*answer)) {
      {
        const std::lock_guard lock{lock_};
        newest_ = std::move(*status);
      }
      news_.signal();
    }
    pollfd nothing{-1, 0, 0};
    if (!over_.load(std::memory_order_relaxed)) poll(&nothing, 1, kLeastMs);
    pollfd wake{wake_.get(), POLLIN, 0};
    poll(&wake, 1, kEveryMs - kLeastMs);
    wake_.clear();
  }
}

std::string query_removal_reason(auth::ControlClient* connection, const rpc::Id& session) {
  if (connection == nullptr) return {};
  const auto answer = connection->ask(rpc::StatusRequest{session}, SessionStatusPoller::kReplyTimeout);
  const auto* refused = answer ? std::get_if<rpc::ErrorReply>(&*answer) : nullptr;
  return refused == nullptr ? std::string() : sanitize(refused->text);
}

}  // namespace tandem::client
