#include "common/transport/secure_channel.h"

#include <algorithm>

namespace tandem::transport {

namespace {
const Secret& secret(const SecureChannel::Params& p, bool outgoing) noexcept {
  return (p.outgoing == Direction::kToServer) == outgoing ? p.secrets.to_server : p.secrets.to_client;
}
}  // namespace

SecureChannel::SecureChannel(const Params& p)
    : own_cid_(p.own_cid),
      peer_cid_(p.peer_cid),
      sending_(secret(p, true), p.secrets.cipher, p.rekey),
      opening_(secret(p, false), p.secrets.cipher),
      timing_(p.tick) {}

std::expected<SecureChannel::Opened, DropReason> SecureChannel::open(Time now,
                                                                     std::span<const std::byte> datagram) noexcept {
  if (const auto header = read_header(datagram)) return open(now, *header, datagram);
  drop(DropReason::kHeader);
  return std::unexpected(DropReason::kHeader);
}

// Flattened: a datagram passes six short functions here, whose calls cost more than their work.
[[gnu::flatten]] std::expected<SecureChannel::Opened, DropReason> SecureChannel::open(
    Time now, const Header& header, std::span<const std::byte> datagram) noexcept {
  const auto refuse = [this](DropReason why) {
    drop(why);
    return std::unexpected(why);
  };
  if (header.cid != own_cid_) return refuse(DropReason::kCid);
  const ReplayWindow::Verdict verdict = window_.check(header.counter);
  if (verdict == ReplayWindow::Verdict::kTooOld) return refuse(DropReason::kTooOld);
  const std::span<std::byte> plaintext{plaintext_.data(), datagram.size() - kHeaderSize - kTagSize};
  if (!opening_.open(now, header, datagram, plaintext)) return refuse(DropReason::kTag);
  if (window_.record(header.counter, verdict) == ReplayWindow::Verdict::kDuplicate)
    return refuse(DropReason::kDuplicate);
  Opened opened{header.type, header.counter, !any_acted_ || header.counter > acted_, plaintext};
  if (!opened.newer && stats_.accepted > 0 && opened.counter >= stats_.first) ++stats_.late;
  return opened;
}

void SecureChannel::accept(Time now, const Opened& opened, const wire::Preamble& preamble) noexcept {
  if (!opened.newer) return;
  if (stats_.accepted == 0) {
    stats_.first = opened.counter;
  } else {
    stats_.longest_gap = std::max(stats_.longest_gap, now - last_acted_);
  }
  ++stats_.accepted;
  stats_.newest = opened.counter;
  acted_ = opened.counter;
  any_acted_ = true;
  last_acted_ = now;
  sending_.echoed(preamble.echo_counter);
  timing_.accepted(now, preamble.echo_counter, std::chrono::microseconds(preamble.echo_age_us), preamble.tick);
}

wire::Preamble SecureChannel::preamble(Time now, std::uint32_t tick) const noexcept {
  if (!any_acted_) return {~std::uint64_t{0}, 0, tick};  // no echo yet: this counter is never sent
  const auto age = std::chrono::duration_cast<std::chrono::microseconds>(now - last_acted_).count();
  return {acted_, static_cast<std::uint32_t>(std::clamp<std::int64_t>(age, 0, 0xffffffffLL)), tick};
}

[[gnu::flatten]] std::size_t SecureChannel::seal(Time now, wire::Type type, std::span<std::byte> datagram,
                                                 std::size_t plaintext_size) noexcept {
  const std::size_t size = kHeaderSize + plaintext_size + kTagSize;
  if (plaintext_size == 0 || size > datagram.size() || size > kDatagramMax) return 0;
  const std::uint64_t counter = sending_.next_counter();
  if (!sending_.seal(now, type, peer_cid_, datagram.first(size))) return 0;
  timing_.sent(now, counter);
  ++stats_.sent;
  return size;
}

void SecureChannel::restart_statistics(Time now) noexcept {
  stats_ = SecureChannelStats{};
  last_acted_ = any_acted_ ? now : last_acted_;
}

}  // namespace tandem::transport
