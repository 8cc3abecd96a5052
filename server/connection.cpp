#include "server/connection.h"

namespace tandem::server {

std::optional<link::Link::Opened> Connection::open(Time now, const Endpoint& from, std::span<const std::byte> bytes,
                                                   wire::Codec& codec) noexcept {
  const auto opened = link_->open(now, bytes);
  if (!opened) return std::nullopt;
  if (!rate_.allow(now)) {
    link_->refuse(link::Refusal::kRate);
    return std::nullopt;
  }
  if (opened->type != wire::Type::kPathResponse) return *opened;
  if (const auto answer = codec.decode_path(opened->plaintext)) {
    link_->accept_other();
    if (proof_.answered(from, answer->message.token)) at_ = from;
  } else {
    link_->refuse_body();
  }
  return std::nullopt;
}

void Connection::acts(Time now, const Endpoint& from, const link::Link::Opened& opened, const wire::Preamble& preamble, PathTokens& tokens) noexcept {
  link_->accept(now, opened, preamble);
  // A challenge must not be larger than what asks for it: else a forged source address would make the server amplify.
  if (at_ != from && opened.plaintext.size() >= wire::kPathSize) proof_.seen(now, from, tokens);
}

std::optional<Transmit> Connection::poll_challenge(Time now, std::uint32_t tick, wire::Codec& codec,
                                                   std::span<std::byte> buffer) noexcept {
  const auto challenge = proof_.due(now);
  if (!challenge) return std::nullopt;
  const std::size_t size = write(now, tick, wire::Type::kPathChallenge, wire::PathMessage{challenge->token}, codec, buffer);
  return size == 0 ? std::nullopt : std::optional{Transmit{challenge->to, size}};
}

}  // namespace tandem::server
