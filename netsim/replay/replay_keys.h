#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/transport/aead.h"
#include "netsim/replay/journal_events.h"

namespace tandem::netsim {

/// Keys of one replayed connection. The journal has no keys; the replay makes its own, and seals the recorded contents
/// under them, so that the session opens them by its own code.
class ReplayKeys {
 public:
  /// @param number  distinguishes the connections of a replay
  explicit ReplayKeys(std::uint64_t number);

  /// The server's end of the connection.
  [[nodiscard]] const transport::ConnectionSecrets& secrets() const noexcept { return secrets_; }

  /// Seals a recorded datagram, under the key that its phase names.
  /// @param own_cid  of the server
  /// @param phase    number of the key with which the server opens now (SecureChannel::receiving_phase)
  /// @return the datagram, valid until the next call; empty if its phase is more than one key away
  [[nodiscard]] std::span<const std::byte> seal(const JournalDatagram& recorded, std::uint32_t own_cid,
                                                std::uint64_t phase);

 private:
  transport::ConnectionSecrets secrets_;
  transport::Secret last_;             ///< of the last key
  std::vector<transport::Aead> keys_;  ///< by phase
  std::array<std::byte, transport::kDatagramMax> datagram_{};
};

}  // namespace tandem::netsim
