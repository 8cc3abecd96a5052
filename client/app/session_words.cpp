#include "client/app/session_words.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <utility>

#include "common/base/printable.h"

namespace tandem::client {
namespace {

constexpr int kEveryMs = 1000;
constexpr int kLeastMs = 150;  // between two questions: a server answers ten a second

void raise(const io::Fd& event) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(event.get(), &one, sizeof one);
}
void lower(const io::Fd& event) {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto read = ::read(event.get(), &count, sizeof count);
}

}  // namespace

SessionWords::SessionWords(std::shared_ptr<trust::ControlClient> connection, const control::Id& session, std::chrono::milliseconds patience)
    : connection_(std::move(connection)),
      patience_(patience),
      socket_(connection_ ? ::fcntl(connection_->fd(), F_DUPFD_CLOEXEC, 0) : -1),
      news_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (connection_) thread_ = std::thread([this, session] { work(session); });
}

SessionWords::~SessionWords() {
  over_.store(true, std::memory_order_relaxed);
  hurry();
  if (thread_.joinable()) thread_.join();
}

void SessionWords::give_up() noexcept { ::shutdown(socket_.get(), SHUT_RDWR); }

void SessionWords::hurry() noexcept { raise(wake_); }

std::optional<control::Status> SessionWords::take() {
  lower(news_);
  const std::lock_guard lock{lock_};
  return std::exchange(newest_, std::nullopt);
}

void SessionWords::work(const control::Id& session) {
  while (!over_.load(std::memory_order_relaxed)) {
    auto answer = connection_->ask(control::StatusRequest{session}, patience_);
    if (!answer) {
      ended_.store(true, std::memory_order_release);
      return;
    }
    if (auto* status = std::get_if<control::Status>(&*answer)) {
      {
        const std::lock_guard lock{lock_};
        newest_ = std::move(*status);
      }
      raise(news_);
    }
    pollfd nothing{-1, 0, 0};
    if (!over_.load(std::memory_order_relaxed)) poll(&nothing, 1, kLeastMs);
    pollfd wake{wake_.get(), POLLIN, 0};
    poll(&wake, 1, kEveryMs - kLeastMs);
    lower(wake_);
  }
}

std::string ask_why_gone(trust::ControlClient* connection, const control::Id& session) {
  if (connection == nullptr) return {};
  const auto answer = connection->ask(control::StatusRequest{session}, SessionWords::kPatience);
  const auto* refused = answer ? std::get_if<control::Refused>(&*answer) : nullptr;
  return refused == nullptr ? std::string() : printable(refused->text);
}

}  // namespace tandem::client
