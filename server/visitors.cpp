#include "server/visitors.h"

#include <algorithm>

namespace tandem::server {

namespace {
constexpr Duration kSilenceMax = std::chrono::seconds(2);  // then the place is free, and nothing more is sent there
}

std::uint32_t Visitors::bind(Time now, const Endpoint& from, std::uint64_t nonce, std::uint32_t client_cid, std::uint32_t drawn,
                             Duration tick) noexcept {
  for (const Visitor& v : visitors_)
    if (v.link && v.nonce == nonce && v.at == from) return v.link->params().own_cid;
  for (Visitor& v : visitors_) {
    if (v.link && now - v.heard <= kSilenceMax) continue;
    v = {};
    v.link.emplace(link::Link::Params{link::Direction::kToClient, drawn, client_cid, tick});
    v.at = from;
    v.nonce = nonce;
    v.heard = now;
    return drawn;
  }
  return 0;
}

bool Visitors::on_datagram(Time now, const Endpoint& from, std::uint32_t cid, std::span<const std::byte> bytes) noexcept {
  const auto found =
      std::ranges::find_if(visitors_, [&](const Visitor& v) { return v.link && v.link->params().own_cid == cid && v.at == from; });
  if (found == visitors_.end()) return false;
  link::Link& link = *found->link;
  const auto opened = link.open(bytes);
  if (!opened) return true;
  if (opened->type == wire::Type::kState) {
    const auto decoded = codec_.decode_state(opened->plaintext);
    if (!decoded) {
      link.refuse_body();
    } else if (opened->newer) {
      link.accept(now, *opened, decoded->preamble);
      found->heard = now;
      found->spoke = true;
    }
  } else if (opened->type == wire::Type::kClose && codec_.decode_close(opened->plaintext)) {
    found->link.reset();
  } else {
    link.refuse_body();
  }
  return true;
}

void Visitors::on_tick(Time now) noexcept {
  for (Visitor& v : visitors_) {
    if (v.link && now - v.heard > kSilenceMax) v.link.reset();
    v.due = v.link && v.spoke;
  }
}

std::optional<Visitors::Transmit> Visitors::poll_transmit(Time now, std::uint32_t tick, std::optional<wire::CloseReason> closing,
                                                          std::span<std::byte> buffer) noexcept {
  if (buffer.size() < link::kHeaderSize) return std::nullopt;
  const auto body = buffer.subspan(link::kHeaderSize);
  for (Visitor& v : visitors_) {
    if (!v.link || !v.due) continue;
    v.due = false;
    const link::LinkStats& s = v.link->stats();
    const wire::VisitReport report{static_cast<std::uint32_t>(s.accepted), static_cast<std::uint32_t>(s.late)};
    const wire::Preamble preamble = v.link->preamble(now, tick);
    const std::size_t plain = closing ? codec_.encode(preamble, wire::CloseMessage{*closing}, body)
                                      : codec_.encode(preamble, wire::force_of(report), body);
    const std::size_t size =
        plain == 0 ? 0 : v.link->seal(now, closing ? wire::Type::kClose : wire::Type::kForce, buffer, plain);
    if (size > 0) return Transmit{v.at, size};
  }
  return std::nullopt;
}

}  // namespace tandem::server
