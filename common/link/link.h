#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "common/base/time.h"
#include "common/link/datagram.h"
#include "common/link/freshness.h"
#include "common/link/ratchet.h"
#include "common/link/replay_window.h"
#include "proto/wire.h"

namespace tandem::link {

/// Why a datagram was dropped; one counter each, no reply, no log line.
enum class Refusal : std::uint8_t { kHeader, kCid, kTooOld, kTag, kDuplicate, kBody, kRate, kRole, kCount };

struct LinkStats {
  std::uint64_t sent = 0;
  std::uint64_t accepted = 0;    ///< strictly newer and in range: they acted
  std::uint64_t late = 0;        ///< authentic, but older than one that acted already
  std::uint64_t others = 0;      ///< authentic messages that are no sample: they use a counter, but nothing was lost
  std::uint64_t first = 0, newest = 0;  ///< counters of the peer between which loss is counted
  std::array<std::uint64_t, static_cast<std::size_t>(Refusal::kCount)> refused{};
  Duration longest_gap{};        ///< between two that acted
  Histogram age;                 ///< of the newest datagram, sampled once per tick [ns]
  [[nodiscard]] std::uint64_t lost() const noexcept {
    const std::uint64_t span = accepted == 0 ? 0 : newest - first + 1;
    const std::uint64_t came = accepted + late + others + refused[static_cast<std::size_t>(Refusal::kRate)];
    return span > came ? span - came : 0;
  }
  [[nodiscard]] double loss_percent() const noexcept {
    return accepted == 0 ? 0 : 100.0 * static_cast<double>(lost()) / static_cast<double>(newest - first + 1);
  }
};

/// One end of a connection: seals, opens, remembers what acted and how old it is. Sans-I/O: it sees time and bytes.
class Link {
 public:
  struct Params {
    Direction outgoing = Direction::kToServer;
    std::uint32_t own_cid = 0;   ///< on datagrams to us
    std::uint32_t peer_cid = 0;  ///< on datagrams from us
    Duration tick = std::chrono::milliseconds(1);
    ConnectionSecrets secrets = {};
    RekeyRule rekey = {};
  };
  /// @throws std::runtime_error if this processor cannot do the cipher
  explicit Link(const Params& p);

  struct Opened {
    wire::Type type = wire::Type::kPing;
    std::uint64_t counter = 0;
    bool newer = false;  ///< strictly newer than everything that acted
    std::span<const std::byte> plaintext;
  };
  /// Header, connection, window and tag; a datagram is marked as seen only when its tag is right. The plaintext lives until the next call.
  [[nodiscard]] std::expected<Opened, Refusal> open(Time now, std::span<const std::byte> datagram) noexcept TANDEM_REALTIME;
  /// The plaintext was decoded and is in range and `newer`: it acts now.
  void accept(Time now, const Opened& opened, const wire::Preamble& preamble) noexcept TANDEM_REALTIME;
  /// Decoded and in range, but no sample (AUTHORITY, PATH).
  void accept_other() noexcept { ++stats_.others; }
  void refuse_body() noexcept { refuse(Refusal::kBody); }
  /// Authentic, and dropped for a reason of the owner's.
  void refuse(Refusal why) noexcept { ++stats_.refused[static_cast<std::size_t>(why)]; }

  /// First bytes of the next plaintext.
  [[nodiscard]] wire::Preamble preamble(Time now, std::uint32_t tick) const noexcept;
  /// Seals `plaintext_size` bytes that already stand behind the header's place in `datagram`.
  /// @return the datagram's size, 0 if it does not fit.
  [[nodiscard]] std::size_t seal(Time now, wire::Type type, std::span<std::byte> datagram, std::size_t plaintext_size) noexcept
      TANDEM_REALTIME;

  /// Longest gap so far, a silence that still lasts included once it is no mere farewell (200 ms).
  [[nodiscard]] Duration longest_gap(Time now) const noexcept {
    const Duration silence = any_acted_ ? now - last_acted_ : Duration{0};
    return silence > std::chrono::milliseconds(200) ? std::max(stats_.longest_gap, silence) : stats_.longest_gap;
  }
  /// Samples the age for the statistics: once per tick.
  void tick(Time now) noexcept {
    if (freshness_.heard()) stats_.age.add(freshness_.age(now).count());
  }
  /// Forgets what was counted, not what is known: a report begins when people begin.
  void restart_statistics(Time now) noexcept;

  [[nodiscard]] const Freshness& freshness() const noexcept { return freshness_; }
  [[nodiscard]] const LinkStats& stats() const noexcept { return stats_; }
  [[nodiscard]] std::uint32_t own_cid() const noexcept { return own_cid_; }
  [[nodiscard]] std::uint32_t peer_cid() const noexcept { return peer_cid_; }
  /// Keys used so far, from 0: to the peer, from the peer.
  [[nodiscard]] std::uint64_t sending_phase() const noexcept { return sending_.phase(); }
  [[nodiscard]] std::uint64_t receiving_phase() const noexcept { return opening_.phase(); }

 private:
  std::uint32_t own_cid_, peer_cid_;
  SendKeys sending_;
  ReceiveKeys opening_;
  ReplayWindow window_;
  Freshness freshness_;
  LinkStats stats_;
  std::uint64_t acted_ = 0;
  bool any_acted_ = false;
  Time last_acted_{};
  std::array<std::byte, kDatagramMax> plaintext_{};
};

}  // namespace tandem::link
