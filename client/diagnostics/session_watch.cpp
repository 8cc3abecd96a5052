#include "client/diagnostics/session_watch.h"

#include <algorithm>

namespace tandem::client {

namespace {
constexpr Duration kWatchInterval{static_cast<Duration::rep>(1e9 / wire::kWatchHz)};
}  // namespace

SessionWatch::SessionWatch(const wire::TelemetryLayout& layout, Duration tick,
                           const transport::SecureChannel::Params& link)
    : codec_(layout), channel_(link, wire::Codec{}), tick_(tick) {
  for (std::size_t i = 0; i < links_.size(); ++i) links_[i].seat = static_cast<std::uint32_t>(i);
  for (std::size_t j = 0; j < authorities_.size(); ++j) {
    authorities_[j].tool = static_cast<std::uint32_t>(j);
    authorities_[j].wanted.fill(wire::kUnknown);
    authorities_[j].applied.fill(wire::kUnknown);
  }
}

bool SessionWatch::on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept {
  transport::SecureChannel& link = channel_.link();
  const auto opened = link.open(arrived, bytes);
  if (!opened) return false;
  if (opened->type == wire::Type::kClose) {
    if (const auto why = channel_.codec().decode_close(opened->plaintext)) {
      closed_ = why->message.reason;
      link.accept_other();
    } else {
      link.drop_body();
    }
    return false;
  }
  if (opened->type == wire::Type::kPathChallenge) {
    channel_.on_path_challenge(opened->plaintext);
    return false;
  }
  const auto decoded = opened->type == wire::Type::kTelemetry
                           ? codec_.decode_telemetry(opened->plaintext)
                           : wire::Decoded<wire::SessionTelemetry>{std::unexpected(wire::DecodeError::kMalformed)};
  if (!decoded) {
    link.drop_body();
    return false;
  }
  if (!opened->newer) return false;
  link.accept(arrived, *opened, decoded->preamble);
  arrived_ = arrived;
  newest_ = decoded->message;
  links_[newest_->link.seat] = newest_->link;
  authorities_[newest_->authority.tool] = newest_->authority;
  return true;
}

std::optional<std::size_t> SessionWatch::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  if (buffer.size() < transport::kHeaderSize) return std::nullopt;
  if (!began_) began_ = next_watch_ = now;
  channel_.link().tick(now);
  const auto tick = static_cast<std::uint32_t>((now - *began_) / tick_);
  if (channel_.answer_due()) return channel_.seal_answer(now, tick, buffer);
  if (close_due_ > 0) {
    --close_due_;
    return channel_.seal(now, tick, wire::Type::kClose, wire::CloseMessage{wire::CloseReason::kLeaving}, buffer);
  }
  if (closed_ || next_watch_ == Time::max() || now < next_watch_) return std::nullopt;
  next_watch_ = std::max(next_watch_ + kWatchInterval, now);
  return channel_.seal(now, tick, wire::Type::kWatch, wire::WatchMessage{}, codec_, buffer);
}

void SessionWatch::leave() noexcept {
  if (next_watch_ == Time::max()) return;
  next_watch_ = Time::max();
  close_due_ = closed_ ? 0 : ClientChannel::kCloseRepeats;
}

Duration SessionWatch::silence(Time now) const noexcept {
  if (arrived_) return std::max(now - *arrived_, Duration{0});
  return began_ ? now - *began_ : Duration{0};
}

}  // namespace tandem::client
