#include "client/app/reconnector.h"

#include <poll.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "common/auth/io/state_directory.h"
#include "common/io/clock.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kBefore = 1s, kBeforeSpread = 500ms;
constexpr Duration kHastened = 300ms, kHastenedSpread = 200ms;
constexpr Duration kAgain = 100ms, kAgainSpread = 150ms;  // pause between two attempts
// Timeout of the first attempt, doubled after each timeout up to the largest. Short first attempts detect a recovered
// network sooner.
constexpr Duration kTimeoutFirst = 1s, kTimeoutMax = 5s;
constexpr double kConnectionSilenceMax = 0.5;  // [s] silence up to which the old connection counts as alive

Duration draw(Duration least, Duration spread) {
  const auto random = auth::random_bytes<std::array<std::byte, 2>>();
  return least + spread * (std::to_integer<int>(random[0]) << 8 | std::to_integer<int>(random[1])) / 65536;
}

/// Compares two addresses without their ports.
bool same_host(const io::SocketAddress& a, const io::SocketAddress& b) {
  const std::string x = io::to_text(a), y = io::to_text(b);
  return x.substr(0, x.rfind(':')) == y.substr(0, y.rfind(':'));
}

}  // namespace

Duration initial_backoff() { return draw(kBefore, kBeforeSpread); }
Duration hastened_backoff() { return draw(kHastened, kHastenedSpread); }

Reconnector::Reconnector(JoinOptions asking, ResumeState own, const Seat& seat, const SeatRunner& runner,
                         const io::UdpSocket& kept)
    : options_(std::move(asking)), resume_state_(std::move(own)), seat_(&seat), runner_(&runner), socket_(&kept) {
  options_.signals = cancel_.get();
  thread_ = std::thread([this] { work(); });
}

Reconnector::~Reconnector() {
  cancel();
  thread_.join();
  if (result_ && *result_ && (*result_)->swap)
    release_seat((*result_)->swap->socket, (*result_)->joined, options_.caps);
}

void Reconnector::work() {
  Duration timeout = kTimeoutFirst;
  MissingSession session;
  while (true) {
    const Time began = io::monotonic_now();
    auto back = attempt(timeout);
    if (back || back.error().kind != ResumeError::Kind::kAgain) {
      result_ = std::move(back);
      break;
    }
    {
      const std::lock_guard lock(mutex_);
      distrust_ = std::move(back.error().distrust);
      if (back.error().heard != SeatAnswer::kNone) answer_ = back.error().answer;
    }
    if (session.on_attempt(io::monotonic_now(), back.error().heard)) {
      result_ = std::unexpected(ResumeError{.kind = ResumeError::Kind::kGone, .reason = back.error().answer});
      break;
    }
    if (back.error().answered) resume_state_.first = back.error().answered;
    if (io::monotonic_now() - began >= timeout) timeout = std::min(2 * timeout, kTimeoutMax);
    const Duration wait = std::max({back.error().wait, session.wait(), draw(kAgain, kAgainSpread)});
    pollfd cancelled{cancel_.get(), POLLIN, 0};
    if (poll(&cancelled, 1, static_cast<int>(wait / 1ms)) > 0) {
      result_ = std::unexpected(ResumeError{.kind = ResumeError::Kind::kInterrupted, .reason = {}});
      break;
    }
  }
  done_.store(true, std::memory_order_release);
  done_event_.signal();
}

std::expected<Reconnector::Resumed, ResumeError> Reconnector::attempt(Duration timeout) {
  options_.timeout = timeout;
  auto given = resume_seat(options_, resume_state_, [this] {
    const ClientStatus now = runner_->status();
    return now.closed || now.silence_s > kConnectionSilenceMax;
  });
  if (!given) return std::unexpected(given.error());
  auto socket = io::connect_udp(given->udp);
  // The server now expects this secret, even if the local socket cannot be opened.
  resume_state_.secrets.insert(resume_state_.secrets.begin(), given->welcome.resume_secret);
  if (!socket) return std::unexpected(ResumeError{.kind = ResumeError::Kind::kAgain, .reason = socket.error()});
  // The socket in use is connected to the server that gave the seat.
  const bool same_server = !resume_state_.last || io::to_text(*resume_state_.last) == io::to_text(given->udp);
  if (same_server && same_host(socket->local, socket_->local))
    if (auto again = io::duplicate(*socket_); again.fd.open()) *socket = std::move(again);
  auto swap = std::make_unique<ConnectionSwap>(std::move(*socket), seat_->prepare(given->link));
  return Resumed{std::move(*given), std::move(swap)};
}

}  // namespace tandem::client
