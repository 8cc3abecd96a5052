#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/byte_ring.h"
#include "common/base/time.h"
#include "common/transport/datagram.h"
#include "common/transport/keyed_hash.h"
#include "proto/rpc/rpc_messages.h"
#include "server/policy/load_shedder.h"
#include "server/session/checkpoint.h"
#include "server/session/input_records.h"
#include "server/session/output_digest.h"
#include "server/session/peer_address.h"

namespace tandem::server {

struct SessionCommand;

/// Journal of everything that enters a session, so that a replay gives the same outputs bit for bit
/// (netsim/replay). It has the authenticated plaintexts, no keys, no secrets and no network addresses: those are
/// replaced by hashes under a key that is not written. Datagrams that do not authenticate only change counters of the
/// connection, so the journal omits them; it also omits peers without a seat, which reach no seat and no tool
/// (ARCHITECTURE.md, invariants 135 to 139). input_records.h has the layout.
///
/// The thread that runs the session writes and a second thread drains, without lock and without heap. If that
/// thread is too slow the journal ends: from this tick on no session can be replayed from it, which it says. The
/// session is undisturbed.
class InputJournal {
 public:
  static constexpr std::size_t kCapacity = std::size_t{8} << 20;  ///< [bytes]: about 2 s of 16 seats at 1 kHz
  /// Returns the bytes of a scene at 1 kHz for about 2 s, at most 1 MiB: about half a second of 8 seats, a quarter
  /// of 16. A seat's datagram grows with each tool that it is coupled to.
  [[nodiscard]] static constexpr std::size_t capacity_for(std::size_t seats, std::size_t tools) noexcept {
    return std::min(std::size_t{1} << 20U, seats * (1 + tools) * 160 * 1024);
  }

  /// @param key       hides network addresses; random, and never written to a file
  /// @param capacity  bytes that wait for the draining thread, at most
  explicit InputJournal(const transport::HashKey& key, std::size_t capacity = kCapacity)
      : ring_(capacity), address_key_(key) {}

  // ---- The draining thread ----
  static constexpr std::size_t kPieceHeader = 8;  ///< [bytes]

  /// Takes the oldest bytes as one piece: its position in the stream (u64, little-endian), then the bytes.
  /// Pieces may end inside of a record. `recordings` keep them in order; a gap shows in the positions.
  /// @param out  larger than kPieceHeader; 64 KiB are enough to keep up
  /// @return size of the piece; 0: nothing waits
  [[nodiscard]] std::size_t drain(std::span<std::byte> out) noexcept;
  /// Number of records that were lost because nothing drained the journal. Any thread.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

  // ---- The thread that runs the session; called by Session ----
  struct Begin {
    std::string_view build;            ///< version and build of the program, at most input::kBuildMax bytes
    Time start;                        ///< of the slaves and of the session
    const Checkpoint* from = nullptr;  ///< that the session was restored from; null: none
    AxisArray scale{};                 ///< tip gain to port gain, per axis
    Checkpoint::Hash scene{};          ///< scene_hash
    std::size_t seats = 0;             ///< number of seats of the scene
  };
  /// Begins the journal of a session. Digests of outputs start from zero.
  void begin(const Begin& begin) noexcept;
  /// Digest of a seat's outputs, to which the seat's connection adds. Valid as long as this.
  [[nodiscard]] OutputDigest& outputs(std::size_t seat) noexcept { return seats_[seat].outputs; }

  void admit(Time now, std::size_t seat, std::uint32_t own_cid, std::uint32_t peer_cid, const rpc::DeviceFacts& device,
             double force_scale, bool same_owner) noexcept;
  /// @param token  that its sender's address is challenged with; null: no challenge began
  void datagram(Time now, std::size_t seat, const PeerAddress& from, const transport::Header& header,
                std::span<const std::byte> plaintext, const std::uint64_t* token) noexcept TANDEM_REALTIME;
  void command(Time now, const SessionCommand& command) noexcept;
  void remove(std::size_t seat, wire::CloseReason why) noexcept;
  void end(wire::CloseReason why) noexcept;
  void contacts(std::size_t tool) noexcept;
  struct Settings {
    LoadState load{};
    bool telemetry_every_tick = true;
    std::uint32_t record_interval = 1;
    bool may_act = true;
    friend bool operator==(const Settings&, const Settings&) = default;
  };
  void tick(Time now, std::uint32_t missed, const Settings& settings) noexcept TANDEM_REALTIME;
  /// Writes the tick with the hashes of what it sent, and shows it to the draining thread.
  void end_tick() noexcept TANDEM_REALTIME;

 private:
  struct Seat {
    PeerAddress from;
    std::uint64_t next_counter = 0;
    OutputDigest outputs;
  };

  /// Memory for a record of this size; null if it is lost, which is counted.
  [[nodiscard]] std::byte* open(std::size_t size) noexcept TANDEM_REALTIME {
    std::byte* const at = overflowed_ ? nullptr : ring_.reserve(size);
    if (at == nullptr) [[unlikely]]
      lose();
    return at;
  }
  void lose() noexcept;
  void write(std::span<const std::byte> record) noexcept;
  /// The settings in one number, which is compared at every tick; never kNoSettings.
  [[nodiscard]] static std::uint64_t word_of(const Settings& settings) noexcept {
    return static_cast<std::uint64_t>(settings.load.level) | (settings.load.overloaded ? 0x100U : 0U) |
           (settings.telemetry_every_tick ? 0x200U : 0U) | (settings.may_act ? 0x400U : 0U) |
           std::uint64_t{settings.record_interval} << 32;
  }
  static constexpr std::uint64_t kNoSettings = ~std::uint64_t{0};
  void write_settings(const Settings& settings) noexcept TANDEM_REALTIME;
  void write_overflow() noexcept TANDEM_REALTIME;
  [[nodiscard]] std::int64_t since_last(Time now) noexcept;

  ByteRing ring_;
  transport::HashKey address_key_;
  std::array<Seat, kSeatsMax> seats_{};
  std::size_t seats_n_ = 0;
  std::uint64_t settings_ = kNoSettings;  ///< as last written, see word_of
  std::uint32_t missed_ = 0;              ///< of the open tick
  bool in_tick_ = false;                  ///< `end_tick` is due
  Time last_{}, tick_at_{};               ///< of the last record with a time; of the open tick
  std::uint64_t ticks_ = 0;               ///< kTick records since `begin`
  bool overflowed_ = false, told_ = false;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace tandem::server
