#include "common/link/link.h"

#include <algorithm>

namespace tandem::link {

namespace {
const Secret& secret(const Link::Params& p, bool outgoing) noexcept {
  return (p.outgoing == Direction::kToServer) == outgoing ? p.secrets.to_server : p.secrets.to_client;
}
}  // namespace

Link::Link(const Params& p)
    : own_cid_(p.own_cid),
      peer_cid_(p.peer_cid),
      sending_(secret(p, true), p.secrets.cipher, p.rekey),
      opening_(secret(p, false), p.secrets.cipher),
      freshness_(p.tick) {}

std::expected<Link::Opened, Refusal> Link::open(Time now, std::span<const std::byte> datagram) noexcept {
  const auto refuse = [this](Refusal why) {
    ++stats_.refused[static_cast<std::size_t>(why)];
    return std::unexpected(why);
  };
  const auto header = read_header(datagram);
  if (!header) return refuse(Refusal::kHeader);
  if (header->cid != own_cid_) return refuse(Refusal::kCid);
  if (window_.judge(header->counter) == ReplayWindow::Verdict::kTooOld) return refuse(Refusal::kTooOld);
  const std::span<std::byte> plaintext{plaintext_.data(), datagram.size() - kHeaderSize - kTagSize};
  if (!opening_.open(now, *header, datagram, plaintext)) return refuse(Refusal::kTag);
  if (window_.note(header->counter) == ReplayWindow::Verdict::kDuplicate) return refuse(Refusal::kDuplicate);
  Opened opened{header->type, header->counter, !any_acted_ || header->counter > acted_, plaintext};
  if (!opened.newer && stats_.accepted > 0 && opened.counter >= stats_.first) ++stats_.late;
  return opened;
}

void Link::accept(Time now, const Opened& opened, const wire::Preamble& preamble) noexcept {
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
  freshness_.accepted(now, preamble.echo_counter, std::chrono::microseconds(preamble.echo_age_us), preamble.tick);
}

wire::Preamble Link::preamble(Time now, std::uint32_t tick) const noexcept {
  if (!any_acted_) return {~std::uint64_t{0}, 0, tick};  // a counter that is never sent: nothing to echo yet
  const auto age = std::chrono::duration_cast<std::chrono::microseconds>(now - last_acted_).count();
  return {acted_, static_cast<std::uint32_t>(std::clamp<std::int64_t>(age, 0, 0xffffffffLL)), tick};
}

std::size_t Link::seal(Time now, wire::Type type, std::span<std::byte> datagram, std::size_t plaintext_size) noexcept {
  const std::size_t size = kHeaderSize + plaintext_size + kTagSize;
  if (plaintext_size == 0 || size > datagram.size() || size > kDatagramMax) return 0;
  const std::uint64_t counter = sending_.next_counter();
  if (!sending_.seal(now, type, peer_cid_, datagram.first(size))) return 0;
  freshness_.sent(now, counter);
  ++stats_.sent;
  return size;
}

void Link::restart_statistics(Time now) noexcept {
  stats_ = LinkStats{};
  last_acted_ = any_acted_ ? now : last_acted_;
}

}  // namespace tandem::link
