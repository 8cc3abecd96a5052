#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/transport/secure_channel.h"
#include "proto/wire/wire_codec.h"
#include "server/session/output_digest.h"
#include "server/session/path_validation.h"
#include "server/session/peer_address.h"
#include "server/session/rate_limit.h"

namespace tandem::server {

/// The server's end of one client's datagrams: keys, address validation, rate limit and send limits. Nothing but
/// challenges is sent before an address is validated.
class Connection {
 public:
  /// @param link  created by the caller outside the real-time path
  /// @param tick  interval between two datagrams of this client
  Connection(Time now, std::unique_ptr<transport::SecureChannel> link, Duration tick) noexcept
      : link_(std::move(link)), admitted_(now), rate_(tick) {}

  using Opened = transport::SecureChannel::Opened;

  /// Opens a datagram. @return its content; an error if it is not of this client, or was opened before
  /// @param header  of the datagram `bytes`
  [[nodiscard]] std::expected<Opened, transport::DropReason> authenticate(
      Time now, const transport::Header& header, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME {
    return link_->open(now, header, bytes);
  }
  /// Handles path messages and the rate limit. @return whether `opened` is for the owner; false if it was handled or
  /// dropped
  [[nodiscard]] bool handle(Time now, const PeerAddress& from, const Opened& opened,
                            wire::Codec& codec) noexcept TANDEM_REALTIME;
  /// `authenticate`, then `handle`.
  [[nodiscard]] std::optional<Opened> open(Time now, const PeerAddress& from, const transport::Header& header,
                                           std::span<const std::byte> bytes,
                                           wire::Codec& codec) noexcept TANDEM_REALTIME;
  /// Records a message that was decoded, is in range and is newer than all before.
  /// @param tokens  for a challenge, if the message came from an address that is not the validated one
  void on_accepted_message(Time now, const PeerAddress& from, const Opened& opened, const wire::Preamble& preamble,
                           PathTokens& tokens) noexcept TANDEM_REALTIME;

  /// An address is being validated, so a challenge may be due.
  [[nodiscard]] bool may_have_challenge() const noexcept { return path_validation_.in_progress(); }
  /// Seals a challenge into `buffer`; nullopt if none is due.
  [[nodiscard]] std::optional<Transmit> poll_challenge(Time now, std::uint32_t tick, wire::Codec& codec,
                                                       std::span<std::byte> buffer) noexcept TANDEM_REALTIME;
  /// Seals `message` for the validated address; size 0 if there is no such address or the buffer is too small.
  /// @param codec  encodes such a message
  template <class Message, class Codec>
  [[nodiscard]] Transmit seal(Time now, std::uint32_t tick, wire::Type type, const Message& message, const Codec& codec,
                              std::span<std::byte> buffer) noexcept {
    if (!proven_address_) return {};
    return {*proven_address_, write(now, tick, type, message, codec, buffer)};
  }

  /// Sets the digest to which all messages from now on are added; null: none. It must outlive this.
  void record_outputs(OutputDigest* outputs) noexcept { outputs_ = outputs; }
  /// True once per flood of this client's own datagrams that lasts longer than RateLimit::kWarnAfter.
  [[nodiscard]] bool poll_flood() noexcept { return rate_.poll_warning(); }

  [[nodiscard]] const std::optional<PeerAddress>& proven_address() const noexcept { return proven_address_; }
  /// Time since a STATE took effect; time since admission if none did.
  [[nodiscard]] Duration silence(Time now) const noexcept {
    return link_->timing().heard() ? link_->timing().silence(now) : now - admitted_;
  }
  /// Whether a FORCE that is due may be sent. A true result counts as sent. Within `kForceSendTime` after a STATE it
  /// is always true, then at most once per `kKeepAliveEvery` for `kKeepAliveFor`, then false until the next STATE.
  [[nodiscard]] bool may_send(Time now) noexcept {
    if (silence(now) > kForceSendTime && (expired(now) || now < last_force_ + kKeepAliveEvery)) return false;
    last_force_ = now;
    return true;
  }
  /// The client has been silent for so long that nothing is sent to it any more.
  [[nodiscard]] bool expired(Time now) const noexcept { return silence(now) > kForceSendTime + kKeepAliveFor; }
  static constexpr Duration kForceSendTime = std::chrono::seconds(2), kKeepAliveEvery = std::chrono::seconds(1),
                            kKeepAliveFor = std::chrono::seconds(60);

  /// Releases the channel, so that another thread frees its memory. No other function may be called afterwards.
  [[nodiscard]] std::unique_ptr<transport::SecureChannel> release_link() noexcept { return std::move(link_); }
  [[nodiscard]] transport::SecureChannel& link() noexcept { return *link_; }
  [[nodiscard]] const transport::SecureChannel& link() const noexcept { return *link_; }

 private:
  template <class Message, class Codec>
  std::size_t write(Time now, std::uint32_t tick, wire::Type type, const Message& message, const Codec& codec,
                    std::span<std::byte> buffer) noexcept {
    if (buffer.size() < transport::kHeaderSize) return 0;
    const std::size_t plain = codec.encode(link_->preamble(now, tick), message, buffer.subspan(transport::kHeaderSize));
    if (outputs_ != nullptr) [[unlikely]]
      outputs_->add(type, buffer.subspan(transport::kHeaderSize, plain));
    return plain == 0 ? 0 : link_->seal(now, type, buffer, plain);
  }

  std::unique_ptr<transport::SecureChannel> link_;
  Time admitted_;
  std::optional<PeerAddress> proven_address_;
  PathValidation path_validation_;
  RateLimit rate_;
  Time last_force_{};  ///< time of the last FORCE that was sent
  OutputDigest* outputs_ = nullptr;
};

}  // namespace tandem::server
