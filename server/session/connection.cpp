#include "server/session/connection.h"

namespace tandem::server {

bool Connection::handle(Time now, const PeerAddress& from, const Opened& opened, wire::Codec& codec) noexcept {
  if (!rate_.allow(now)) {
    link_->drop(transport::DropReason::kRate);
    return false;
  }
  if (opened.type != wire::Type::kPathResponse) [[likely]]
    return true;
  if (const auto answer = codec.decode_path(opened.plaintext)) {
    link_->accept_other();
    if (path_validation_.on_response(from, answer->message.token)) proven_address_ = from;
  } else {
    link_->drop_body();
  }
  return false;
}

std::optional<Connection::Opened> Connection::open(Time now, const PeerAddress& from, const transport::Header& header,
                                                   std::span<const std::byte> bytes, wire::Codec& codec) noexcept {
  const auto opened = authenticate(now, header, bytes);
  return opened && handle(now, from, *opened, codec) ? std::optional{*opened} : std::nullopt;
}

void Connection::on_accepted_message(Time now, const PeerAddress& from, const transport::SecureChannel::Opened& opened,
                                     const wire::Preamble& preamble, PathTokens& tokens) noexcept {
  link_->accept(now, opened, preamble);
  // A challenge must not be larger than the datagram that causes it. Otherwise a forged source address would turn the
  // server into an amplifier.
  if (proven_address_ != from && opened.plaintext.size() >= wire::kPathSize)
    path_validation_.on_datagram_from(now, from, tokens);
}

std::optional<Transmit> Connection::poll_challenge(Time now, std::uint32_t tick, wire::Codec& codec,
                                                   std::span<std::byte> buffer) noexcept {
  const auto challenge = path_validation_.challenge_due(now);
  if (!challenge) return std::nullopt;
  const std::size_t size =
      write(now, tick, wire::Type::kPathChallenge, wire::PathMessage{challenge->token}, codec, buffer);
  return size == 0 ? std::nullopt : std::optional{Transmit{challenge->to, size}};
}

}  // namespace tandem::server
