#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/base/time.h"
#include "netsim/engine/path.h"
#include "netsim/models/path_spec.h"
#include "netsim/quality/link_summary.h"

namespace tandem::netsim {

/// Preview of a network: simulates 128-byte datagrams at 1 kHz in both directions in virtual time and records the
/// result.
struct ProfilePreviewOptions {
  LinkSpec link;
  std::uint64_t seed = 1;
  Duration length = std::chrono::minutes(30);  ///< duration of the simulation, at least 1 s
  Duration shown = std::chrono::seconds(60);   ///< initial part kept per datagram, at most `length`
};

/// Results of one direction.
struct ProfilePreviewDirection {
  static constexpr std::int32_t kLost = -1;

  /// One-way delays of all arrived datagrams, ascending; copies do not count.
  std::vector<Duration> delays;
  /// Delay of each datagram of the shown time [us], or kLost; one datagram per millisecond.
  std::vector<std::int32_t> shown;
  std::array<std::uint64_t, kOutcomes> fates{};  ///< outcomes of all sent datagrams

  /// Returns the delay that a share q of the datagrams does not exceed, counted as in profile checks; 0 if none
  /// arrived.
  [[nodiscard]] Duration quantile(double q) const noexcept;
};

/// Results of a preview; `shown` is the part kept per datagram.
struct ProfilePreview {
  Duration length{}, shown{};
  std::array<ProfilePreviewDirection, kDirections> ways;  ///< up, down
  LinkSummary quality;
};

/// Simulates and records a preview.
/// @param progress  called periodically with the completed share in [0, 1]; returning false ends the preview early,
/// with a correspondingly shorter `length`; may be empty
/// @throws std::invalid_argument listing all errors of the link.
[[nodiscard]] ProfilePreview preview_profile(const ProfilePreviewOptions& setup,
                                             const std::function<bool(double)>& progress = {});

}  // namespace tandem::netsim
