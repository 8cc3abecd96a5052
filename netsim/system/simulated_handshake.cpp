#include "netsim/system/simulated_handshake.h"

#include "client/seat/device_facts.h"
#include "server/session/connection_id.h"

namespace tandem::netsim {

namespace {

transport::Secret drawn_secret(RandomKey key) noexcept {
  transport::Secret secret;
  for (std::size_t i = 0; i < secret.bytes.size(); ++i)
    secret.bytes[i] = static_cast<std::byte>(key.bits(i / 8) >> (8 * (i % 8)) & 0xff);
  return secret;
}

/// Returns the client's end of a connection; the server's end has the two ids exchanged.
transport::SecureChannel::Params client_end(RandomKey key, std::uint8_t slot, std::size_t place, Duration tick) {
  return {.outgoing = transport::Direction::kToServer,
          .own_cid = static_cast<std::uint32_t>(key.bits(0) | 1),
          .peer_cid =
              server::connection_id(static_cast<std::uint16_t>(key.bits(1)), slot, static_cast<std::uint8_t>(place)),
          .tick = tick,
          .secrets = {.cipher = transport::fastest_cipher(),
                      .to_server = drawn_secret(key.derive(1)),
                      .to_client = drawn_secret(key.derive(2))}};
}

transport::SecureChannel::Params server_end(transport::SecureChannel::Params p) {
  std::swap(p.own_cid, p.peer_cid);
  p.outgoing = transport::Direction::kToClient;
  return p;
}

}  // namespace

void fill_path_tokens(server::Session& session, RandomKey key, std::uint64_t first) noexcept {
  server::PathTokens& tokens = session.path_tokens();
  while (tokens.free_slots() > 0) tokens.add(key.bits(first++));
}

std::expected<SimulatedJoin, server::JoinResult> simulate_join(server::Session& session, Time now, std::size_t seat,
                                                               const hal::DeviceCaps& caps, RandomKey key,
                                                               std::uint64_t number, bool same_owner,
                                                               std::uint8_t slot) {
  fill_path_tokens(session, key.derive(number).derive(3), 0);
  const server::SeatCatalogue& catalogue = session.seat_catalogue();
  if (seat >= catalogue.scene().seats.size()) return std::unexpected(server::JoinResult::kNoSuchSeat);
  if (!catalogue.device_incompatibility(client::device_facts(caps)).empty())
    return std::unexpected(server::JoinResult::kDeviceUnfit);
  const transport::SecureChannel::Params client = client_end(key.derive(number), slot, seat + 1, catalogue.tick());
  server::SeatConnection entry = catalogue.make_connection(seat, server_end(client), client::device_facts(caps));
  const server::JoinResult result = session.admit(now, seat, entry, same_owner);
  if (result != server::JoinResult::kAccepted) return std::unexpected(result);
  return SimulatedJoin{catalogue.setup_for(seat, client::device_facts(caps)), client};
}

namespace {
std::expected<SimulatedJoin, server::JoinResult> join_slot(server::Session& session, server::PeerSlots& slots, Time now,
                                                           RandomKey key, std::uint64_t number, std::size_t place,
                                                           bool every_tick) {
  fill_path_tokens(session, key.derive(number).derive(3), 0);
  const server::SeatCatalogue& catalogue = session.seat_catalogue();
  const transport::SecureChannel::Params client = client_end(key.derive(number), 0, place, catalogue.tick());
  auto link = std::make_unique<transport::SecureChannel>(server_end(client));
  std::size_t slot = 0;
  const server::JoinResult result = slots.admit(now, link, slot, every_tick);
  if (result != server::JoinResult::kAccepted) return std::unexpected(result);
  return SimulatedJoin{catalogue.setup(0), client};
}
}  // namespace

std::expected<SimulatedJoin, server::JoinResult> simulate_link_test_join(server::Session& session, Time now,
                                                                         RandomKey key, std::uint64_t number) {
  return join_slot(session, session.link_test_peers().slots(), now, key, number, kSeatsMax + 1, true);
}

std::expected<SimulatedJoin, server::JoinResult> simulate_watch_join(server::Session& session, Time now, RandomKey key,
                                                                     std::uint64_t number, bool recorder) {
  return join_slot(session, session.watchers().slots(), now, key, number, kSeatsMax + 2, recorder);
}

}  // namespace tandem::netsim
