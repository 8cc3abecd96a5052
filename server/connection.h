#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/link/link.h"
#include "proto/wire_codec.h"
#include "server/endpoint.h"
#include "server/path_proof.h"
#include "server/rate_limit.h"

namespace tandem::server {

/// The server's end of one client's datagrams: keys, what acted, and where he is. Whoever writes to him asks `at` first: there is no
/// address before one was proven.
class Connection {
 public:
  /// @param link  made where memory may be taken  @param tick  between two datagrams of this client
  Connection(Time now, std::unique_ptr<link::Link> link, Duration tick) noexcept
      : link_(std::move(link)), admitted_(now), rate_(tick) {}

  /// Opens a datagram; what is about the path is dealt with here. @return a message for the owner, else nothing
  [[nodiscard]] std::optional<link::Link::Opened> open(Time now, const Endpoint& from, std::span<const std::byte> bytes,
                                                       wire::Codec& codec) noexcept TANDEM_REALTIME;
  /// The message was decoded, in range and newer than all before: it acts.
  /// @param tokens  for a challenge, where it came from an address that is not the proven one
  void acts(Time now, const Endpoint& from, const link::Link::Opened& opened, const wire::Preamble& preamble, PathTokens& tokens) noexcept TANDEM_REALTIME;

  /// Somebody is being asked whether he is there: a challenge may be due.
  [[nodiscard]] bool challenges() const noexcept { return proof_.asking(); }
  /// A challenge that is due, sealed into `buffer`.
  [[nodiscard]] std::optional<Transmit> poll_challenge(Time now, std::uint32_t tick, wire::Codec& codec,
                                                       std::span<std::byte> buffer) noexcept TANDEM_REALTIME;
  /// Seals `message` for the proven address; size 0 when there is none or nothing could be written.
  template <class Message>
  [[nodiscard]] Transmit seal(Time now, std::uint32_t tick, wire::Type type, const Message& message, wire::Codec& codec,
                              std::span<std::byte> buffer) noexcept {
    if (!at_) return {};
    return {*at_, write(now, tick, type, message, codec, buffer)};
  }

  /// Once for each flood of this client's own datagrams that goes on for too long.
  [[nodiscard]] bool poll_flood() noexcept { return rate_.poll_warning(); }

  [[nodiscard]] const std::optional<Endpoint>& at() const noexcept { return at_; }
  /// Since a STATE acted; since admission while none did.
  [[nodiscard]] Duration silence(Time now) const noexcept {
    return link_->freshness().heard() ? link_->freshness().silence(now) : now - admitted_;
  }
  /// Whether the peer may be sent a FORCE that is due: always within `kForceStops` after a STATE acted, then at most once per
  /// `kKeepAliveEvery` for `kKeepAliveFor`, then never, until a STATE acts again. A true answer counts as sent.
  [[nodiscard]] bool may_be_told(Time now) noexcept {
    if (silence(now) > kForceStops && (forgotten(now) || now < told_ + kKeepAliveEvery)) return false;
    told_ = now;
    return true;
  }
  /// Silent for so long that nothing at all goes there any more.
  [[nodiscard]] bool forgotten(Time now) const noexcept { return silence(now) > kForceStops + kKeepAliveFor; }
  static constexpr Duration kForceStops = std::chrono::seconds(2), kKeepAliveEvery = std::chrono::seconds(1), kKeepAliveFor = std::chrono::seconds(60);

  /// For whoever may give memory back; nothing else may be called afterwards.
  [[nodiscard]] std::unique_ptr<link::Link> give_up() noexcept { return std::move(link_); }
  [[nodiscard]] link::Link& link() noexcept { return *link_; }
  [[nodiscard]] const link::Link& link() const noexcept { return *link_; }

 private:
  template <class Message>
  std::size_t write(Time now, std::uint32_t tick, wire::Type type, const Message& message, wire::Codec& codec,
                    std::span<std::byte> buffer) noexcept {
    if (buffer.size() < link::kHeaderSize) return 0;
    const std::size_t plain = codec.encode(link_->preamble(now, tick), message, buffer.subspan(link::kHeaderSize));
    return plain == 0 ? 0 : link_->seal(now, type, buffer, plain);
  }

  std::unique_ptr<link::Link> link_;
  Time admitted_;
  std::optional<Endpoint> at_;
  PathProof proof_;
  RateLimit rate_;
  Time told_{};  ///< the last FORCE that was due
};

}  // namespace tandem::server
