#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "proto/rpc/rpc_messages.h"
#include "server/session/checkpoint.h"
#include "server/session/input_journal.h"
#include "server/session/peer_address.h"
#include "server/session/session_command.h"

/// Records of an input journal, decoded (server/session/input_records.h).
namespace tandem::netsim {

/// A session begins; those before it in the same journal have ended, or their server failed.
struct JournalBegin {
  std::string build;                       ///< version and build of the program that recorded
  server::Checkpoint::Hash scene{};        ///< scene_hash of the scene
  AxisArray scale{};                       ///< tip gain to port gain, per axis
  Time start;                              ///< of the slaves and of the session
  std::optional<server::Checkpoint> from;  ///< that the session was restored from
};

/// A client took a seat.
struct JournalAdmit {
  Time at;
  std::size_t seat = 0;
  bool same_owner = false;
  std::uint32_t own_cid = 0, peer_cid = 0;  ///< of the server, of the client
  rpc::DeviceFacts device;
  double force_scale = 1;
};

/// A datagram that opened under the keys of a seat's client.
struct JournalDatagram {
  Time at;
  std::size_t seat = 0;
  wire::Type type = wire::Type::kPing;
  std::uint8_t key_phase = 0;
  std::uint64_t counter = 0;
  server::PeerAddress from;                ///< stands for the sender's address: equal for equal addresses of this seat
  std::optional<std::uint64_t> token;      ///< that its address is challenged with
  std::span<const std::byte> plaintext{};  ///< valid until the reader is used again
};

/// A stop, pause, resume or change of authority by a control connection.
struct JournalCommand {
  Time at;
  server::SessionCommand command;
};

struct JournalRemove {
  std::size_t seat = 0;
  wire::CloseReason why = wire::CloseReason::kRemoved;
};

struct JournalEnd {
  wire::CloseReason why = wire::CloseReason::kDone;
};

/// The surfaces near a tool come from a source that the journal does not have.
struct JournalContacts {
  std::size_t tool = 0;
};

/// A tick, and the hash of what it sent.
struct JournalTick {
  Time at;
  std::uint32_t missed = 0;
  server::InputJournal::Settings settings;
  std::uint32_t sent = 0;                          ///< bit i: something was sent to seat i
  std::array<std::uint16_t, kSeatsMax> outputs{};  ///< low bits of OutputDigest::value, of the seats in `sent`
};

/// The journal lost records after this number of ticks; there is nothing about the session behind it.
struct JournalOverflow {
  std::uint64_t ticks = 0;
};

using JournalEvent = std::variant<JournalBegin, JournalAdmit, JournalDatagram, JournalCommand, JournalRemove,
                                  JournalEnd, JournalContacts, JournalTick, JournalOverflow>;

}  // namespace tandem::netsim
