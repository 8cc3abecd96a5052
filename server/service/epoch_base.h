#pragma once

#include <algorithm>
#include <cstdint>

#include "server/service/service_directory.h"
#include "server/service/service_session.h"

namespace tandem::server {

/// The number to be added to revisions of ownerships of the present directory, so that these epochs are higher than all
/// epochs of lost directories. Servers which have seen different ones agree: each takes the highest base that it sees.
class EpochBase {
 public:
  /// @param directory  must outlive this
  /// @param known      from before a restart
  EpochBase(const ServiceDirectory& directory, std::int64_t known)
      : directory_(directory), base_(std::clamp(known, std::int64_t{0}, kBaseMax)) {}

  [[nodiscard]] std::int64_t value() const noexcept { return base_; }
  /// Takes the base of a session of the directory.
  void take(std::int64_t base) noexcept { base_ = std::clamp(base, base_, kBaseMax); }
  /// Takes the bases of all sessions and servers of the directory.
  void learn();
  /// The directory is another one than before.
  void raise() noexcept;
  /// Returns the spec with an epoch that clients have not seen.
  [[nodiscard]] ServiceSession on(ServiceSession spec);

 private:
  /// Epochs of one directory: more revisions than any has, so that servers which know different ones agree on a base.
  static constexpr std::int64_t kEpochs = std::int64_t{1} << 40;
  static constexpr std::int64_t kBaseMax = std::int64_t{1} << 61;

  const ServiceDirectory& directory_;
  std::int64_t base_ = 0;
};

}  // namespace tandem::server
