#include "netsim/world_joining.h"

#include "client/device_facts.h"
#include "server/connection_id.h"

namespace tandem::netsim {

namespace {

link::Secret drawn_secret(RandomKey key) noexcept {
  link::Secret secret;
  for (std::size_t i = 0; i < secret.bytes.size(); ++i)
    secret.bytes[i] = static_cast<std::byte>(key.bits(i / 8) >> (8 * (i % 8)) & 0xff);
  return secret;
}

/// The client's end of a connection; the server's has the ids the other way round.
link::Link::Params client_end(RandomKey key, std::uint8_t slot, std::size_t place, Duration tick) {
  link::Link::Params p;
  p.outgoing = link::Direction::kToServer;
  p.own_cid = static_cast<std::uint32_t>(key.bits(0) | 1);
  p.peer_cid = server::connection_id(static_cast<std::uint16_t>(key.bits(1)), slot, static_cast<std::uint8_t>(place));
  p.tick = tick;
  p.secrets.cipher = link::fastest_cipher();
  p.secrets.to_server = drawn_secret(key.derive(1));
  p.secrets.to_client = drawn_secret(key.derive(2));
  return p;
}

link::Link::Params server_end(link::Link::Params p) {
  std::swap(p.own_cid, p.peer_cid);
  p.outgoing = link::Direction::kToClient;
  return p;
}

}  // namespace

void fill_path_tokens(server::Session& session, RandomKey key, std::uint64_t first) noexcept {
  server::PathTokens& tokens = session.path_tokens();
  while (tokens.room() > 0) tokens.add(key.bits(first++));
}

std::expected<VirtualSeat, server::JoinResult> join_virtually(server::Session& session, Time now, std::size_t seat,
                                                            const hal::DeviceCaps& caps, RandomKey key, std::uint64_t number,
                                                            bool same_owner, std::uint8_t slot) {
  fill_path_tokens(session, key.derive(number).derive(3), 0);
  const server::Reception& reception = session.reception();
  if (seat >= reception.scene().seats.size()) return std::unexpected(server::JoinResult::kNoSuchSeat);
  if (!reception.unfit(client::device_facts(caps)).empty()) return std::unexpected(server::JoinResult::kDeviceUnfit);
  const link::Link::Params client = client_end(key.derive(number), slot, seat + 1, reception.tick());
  server::Entry entry = reception.prepare(seat, server_end(client), client::device_facts(caps));
  const server::JoinResult result = session.admit(now, seat, entry, same_owner);
  if (result != server::JoinResult::kAccepted) return std::unexpected(result);
  return VirtualSeat{reception.setup_for(seat, client::device_facts(caps)), client};
}

std::expected<VirtualSeat, server::JoinResult> visit_virtually(server::Session& session, Time now, RandomKey key, std::uint64_t number) {
  fill_path_tokens(session, key.derive(number).derive(3), 0);
  const server::Reception& reception = session.reception();
  const link::Link::Params client = client_end(key.derive(number), 0, kSeatsMax + 1, reception.tick());
  auto link = std::make_unique<link::Link>(server_end(client));
  const server::JoinResult result = session.admit_visitor(now, link);
  if (result != server::JoinResult::kAccepted) return std::unexpected(result);
  return VirtualSeat{reception.setup(0), client};
}

}  // namespace tandem::netsim
