#include "client/app/come_back.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "common/io/clock.h"
#include "common/trust/io/state_folder.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Duration kBefore = 1s, kBeforeSpread = 500ms;
constexpr Duration kAgain = 100ms, kAgainSpread = 150ms;  // where nobody listens
constexpr Duration kPatienceFirst = 1s, kPatienceMax = 5s;  // where nobody answers: a new attempt finds a network that came back sooner
constexpr double kNews = 0.5;  // [s] silence in which the old connection counts as alive

Duration draw(Duration least, Duration spread) {
  const auto random = trust::random_bytes<std::array<std::byte, 2>>();
  return least + spread * (std::to_integer<int>(random[0]) << 8 | std::to_integer<int>(random[1])) / 65536;
}

/// Whatever the port.
bool same_host(const io::SocketAddress& a, const io::SocketAddress& b) {
  const std::string x = io::to_text(a), y = io::to_text(b);
  return x.substr(0, x.rfind(':')) == y.substr(0, y.rfind(':'));
}

void raise(const io::Fd& event) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(event.get(), &one, sizeof one);
}

}  // namespace

Duration draw_wait_before_return() { return draw(kBefore, kBeforeSpread); }

ComeBack::ComeBack(Asking asking, OwnSeat own, const Seat& seat, const SeatPump& pump, const io::UdpSocket& kept)
    : asking_(std::move(asking)), own_(std::move(own)), seat_(&seat), pump_(&pump), kept_(&kept), cancel_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), done_event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  asking_.signals = cancel_.get();
  thread_ = std::thread([this] { work(); });
}

ComeBack::~ComeBack() {
  if (!done()) raise(cancel_);  // afterwards it would only disturb the connection that was handed on
  thread_.join();
  if (result_ && *result_ && (*result_)->handover) give_back((*result_)->handover->socket, (*result_)->given, asking_.caps);
}

void ComeBack::work() {
  Duration patience = kPatienceFirst;
  while (true) {
    const Time began = io::monotonic_now();
    auto back = attempt(patience);
    if (back || back.error().kind != NotBack::Kind::kAgain) {
      result_ = std::move(back);
      break;
    }
    if (io::monotonic_now() - began >= patience) patience = std::min(2 * patience, kPatienceMax);
    const Duration wait = std::max(back.error().wait, draw(kAgain, kAgainSpread));
    pollfd cancelled{cancel_.get(), POLLIN, 0};
    if (poll(&cancelled, 1, static_cast<int>(wait / 1ms)) > 0) {
      result_ = std::unexpected(NotBack{NotBack::Kind::kInterrupted, {}, {}});
      break;
    }
  }
  done_.store(true, std::memory_order_release);
  raise(done_event_);
}

std::expected<ComeBack::Back, NotBack> ComeBack::attempt(Duration patience) {
  asking_.patience = patience;
  auto given = ask_for_own_seat(asking_, own_, [this] {
    const ClientStatus now = pump_->status();
    return now.closed || now.silence_s > kNews;
  });
  if (!given) return std::unexpected(given.error());
  auto socket = io::connect_udp(given->udp);
  // Its secret is the newest now, whether or not it could be used.
  own_.secrets.insert(own_.secrets.begin(), given->welcome.resume_secret);
  if (!socket) return std::unexpected(NotBack{NotBack::Kind::kAgain, socket.error(), {}});
  if (same_host(socket->local, kept_->local))
    if (auto again = io::duplicate(*kept_); again.fd.open()) *socket = std::move(again);
  auto handover = std::make_unique<SeatPump::Handover>(SeatPump::Handover{std::move(*socket), seat_->prepare(given->link)});
  return Back{std::move(*given), std::move(handover)};
}

}  // namespace tandem::client
