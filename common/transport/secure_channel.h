#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "common/base/time.h"
#include "common/transport/datagram.h"
#include "common/transport/link_timing.h"
#include "common/transport/ratchet.h"
#include "common/transport/replay_window.h"
#include "proto/wire/wire_messages.h"

namespace tandem::transport {

/// Reason for which a datagram was dropped. Each reason has a counter; a drop causes no reply and no log line.
enum class DropReason : std::uint8_t { kHeader, kCid, kTooOld, kTag, kDuplicate, kBody, kRate, kRole, kCount };

/// Counters of one end of a connection.
struct SecureChannelStats {
  std::uint64_t sent = 0;
  std::uint64_t accepted = 0;  ///< strictly newer and in range: applied
  std::uint64_t late = 0;      ///< authentic, but older than an applied one
  std::uint64_t others =
      0;  ///< authentic messages that are no samples: they use a counter, so they do not count as lost
  std::uint64_t first = 0, newest = 0;  ///< counters of the peer between which loss is counted
  std::array<std::uint64_t, static_cast<std::size_t>(DropReason::kCount)> dropped{};
  Duration longest_gap{};  ///< between two applied datagrams
  LinkHistogram age;       ///< of the newest datagram, sampled once per tick [ns]
  [[nodiscard]] std::uint64_t lost() const noexcept {
    const std::uint64_t span = accepted == 0 ? 0 : newest - first + 1;
    const std::uint64_t came = accepted + late + others + dropped[static_cast<std::size_t>(DropReason::kRate)];
    return span > came ? span - came : 0;
  }
  [[nodiscard]] double loss_percent() const noexcept {
    return accepted == 0 ? 0 : 100.0 * static_cast<double>(lost()) / static_cast<double>(newest - first + 1);
  }
};

/// One end of a secure datagram channel: seals and opens datagrams, and tracks the newest applied one and its age.
/// Sans-I/O: time and bytes are arguments.
class SecureChannel {
 public:
  struct Params {
    Direction outgoing = Direction::kToServer;
    std::uint32_t own_cid = 0;   ///< on datagrams to this end
    std::uint32_t peer_cid = 0;  ///< on datagrams from this end
    Duration tick = std::chrono::milliseconds(1);
    ConnectionSecrets secrets = {};
    RekeyPolicy rekey = {};
  };
  /// @throws std::runtime_error if this processor does not support the cipher
  explicit SecureChannel(const Params& p);

  struct Opened {
    wire::Type type = wire::Type::kPing;
    std::uint64_t counter = 0;
    bool newer = false;  ///< strictly newer than all applied datagrams
    std::span<const std::byte> plaintext;
  };
  /// Checks header, connection id, window and tag, and decrypts. A datagram is marked as seen only if its tag is right.
  /// The plaintext is valid until the next call.
  [[nodiscard]] std::expected<Opened, DropReason> open(Time now,
                                                       std::span<const std::byte> datagram) noexcept TANDEM_REALTIME;
  /// Does the same for a datagram whose header was read already. @param header  result of `read_header(datagram)`
  [[nodiscard]] std::expected<Opened, DropReason> open(Time now, const Header& header,
                                                       std::span<const std::byte> datagram) noexcept TANDEM_REALTIME;
  /// Applies an opened datagram that is `newer`, decoded and in range.
  void accept(Time now, const Opened& opened, const wire::Preamble& preamble) noexcept TANDEM_REALTIME;
  /// Counts an opened datagram that is decoded and in range but no sample (AUTHORITY, PATH).
  void accept_other() noexcept { ++stats_.others; }
  void drop_body() noexcept { drop(DropReason::kBody); }
  /// Counts an authentic datagram that the owner dropped for this reason.
  void drop(DropReason why) noexcept { ++stats_.dropped[static_cast<std::size_t>(why)]; }

  /// Returns the first bytes of the next plaintext.
  [[nodiscard]] wire::Preamble preamble(Time now, std::uint32_t tick) const noexcept;
  /// Seals `plaintext_size` bytes that the caller placed behind the header in `datagram`.
  /// @return the datagram's size; 0 if it does not fit.
  [[nodiscard]] std::size_t seal(Time now, wire::Type type, std::span<std::byte> datagram,
                                 std::size_t plaintext_size) noexcept TANDEM_REALTIME;

  /// Returns the longest gap so far. A continuing silence counts once it exceeds 200 ms, so that the end of a session
  /// does not.
  [[nodiscard]] Duration longest_gap(Time now) const noexcept {
    const Duration silence = any_acted_ ? now - last_acted_ : Duration{0};
    return silence > std::chrono::milliseconds(200) ? std::max(stats_.longest_gap, silence) : stats_.longest_gap;
  }
  /// Samples the age for the statistics. Called once per tick, before the age is used.
  void tick(Time now) noexcept {
    timing_.tick(now);
    if (timing_.heard()) stats_.age.add(timing_.age(now).count());
  }
  /// Resets the counters but keeps keys and timing. Reports count from the start of the session.
  void restart_statistics(Time now) noexcept;

  [[nodiscard]] const LinkTiming& timing() const noexcept { return timing_; }
  [[nodiscard]] const SecureChannelStats& stats() const noexcept { return stats_; }
  [[nodiscard]] std::uint32_t own_cid() const noexcept { return own_cid_; }
  [[nodiscard]] std::uint32_t peer_cid() const noexcept { return peer_cid_; }
  /// Number of keys used so far, from 0: towards the peer, from the peer.
  [[nodiscard]] std::uint64_t sending_phase() const noexcept { return sending_.phase(); }
  [[nodiscard]] std::uint64_t receiving_phase() const noexcept { return opening_.phase(); }

 private:
  std::uint32_t own_cid_, peer_cid_;
  SendKeys sending_;
  ReceiveKeys opening_;
  ReplayWindow window_;
  LinkTiming timing_;
  SecureChannelStats stats_;
  std::uint64_t acted_ = 0;
  bool any_acted_ = false;
  Time last_acted_{};
  std::array<std::byte, kDatagramMax> plaintext_{};
};

}  // namespace tandem::transport
