#include "server/visitors.h"

#include <algorithm>
#include <utility>

namespace tandem::server {

namespace {
constexpr Duration kSilenceMax = std::chrono::seconds(2);  // then the place is free, and nothing more is sent there
constexpr unsigned kCloseRepeats = 20;                      // ticks: one may be lost
}

std::optional<std::size_t> Visitors::admit(Time now, std::unique_ptr<link::Link>& link) noexcept {
  for (std::size_t i = 0; i < kMax; ++i) {
    Visitor& v = visitors_[i];
    if (v.here && v.connection->silence(now) <= kSilenceMax) continue;
    std::unique_ptr<link::Link> before = v.connection ? v.connection->give_up() : nullptr;
    v.connection.emplace(now, std::exchange(link, std::move(before)), tick_);
    v.here = true;
    v.due = false;
    v.farewells = 0;
    return i;
  }
  return std::nullopt;
}

std::size_t Visitors::free(Time now) const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(visitors_, [&](const Visitor& v) { return !v.here || v.connection->silence(now) > kSilenceMax; }));
}

bool Visitors::dismiss(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept {
  if (place >= kMax || !visitors_[place].here || visitors_[place].connection->link().own_cid() != cid) return false;
  visitors_[place].farewells = kCloseRepeats;
  visitors_[place].why = why;
  return true;
}

bool Visitors::on_datagram(Time now, const Endpoint& from, std::uint32_t cid, std::span<const std::byte> bytes,
                           PathTokens& tokens) noexcept {
  const auto found =
      std::ranges::find_if(visitors_, [&](const Visitor& v) { return v.here && v.connection->link().own_cid() == cid; });
  if (found == visitors_.end()) return false;
  Connection& connection = *found->connection;
  const auto opened = connection.open(now, from, bytes, codec_);
  if (!opened) return true;
  if (opened->type == wire::Type::kState) {
    const auto decoded = codec_.decode_state(opened->plaintext);
    if (!decoded) {
      connection.link().refuse_body();
    } else if (opened->newer) {
      connection.acts(now, from, *opened, decoded->preamble, tokens);
    }
  } else if (opened->type == wire::Type::kClose && codec_.decode_close(opened->plaintext)) {
    found->here = false;
  } else {
    connection.link().refuse_body();
  }
  return true;
}

void Visitors::on_tick(Time now) noexcept {
  for (Visitor& v : visitors_) {
    v.here = v.here && v.connection->silence(now) <= kSilenceMax;
    v.due = v.here && v.connection->at();
  }
}

std::optional<Transmit> Visitors::poll_transmit(Time now, std::uint32_t tick, std::optional<wire::CloseReason> closing,
                                                std::span<std::byte> buffer) noexcept {
  for (Visitor& v : visitors_) {
    if (!v.here) continue;
    if (const auto challenge = v.connection->poll_challenge(now, tick, codec_, buffer)) return challenge;
    if (!v.due) continue;
    v.due = false;
    if (v.farewells > 0) {
      v.here = --v.farewells > 0;
      const Transmit last = v.connection->seal(now, tick, wire::Type::kClose, wire::CloseMessage{v.why}, codec_, buffer);
      if (last.size > 0) return last;
      continue;
    }
    const link::LinkStats& s = v.connection->link().stats();
    const wire::VisitReport report{static_cast<std::uint32_t>(s.accepted), static_cast<std::uint32_t>(s.late)};
    const Transmit out =
        closing ? v.connection->seal(now, tick, wire::Type::kClose, wire::CloseMessage{*closing}, codec_, buffer)
                : v.connection->seal(now, tick, wire::Type::kForce, wire::force_of(report), codec_, buffer);
    if (out.size > 0) return out;
  }
  return std::nullopt;
}

}  // namespace tandem::server
