#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/base/time.h"
#include "netsim/path.h"
#include "netsim/path_spec.h"
#include "netsim/quality_summary.h"

namespace tandem::netsim {

/// What a network does to datagrams of 128 bytes at 1 kHz, both ways: played in virtual time and looked at.
struct PortraitSetup {
  LinkSpec link;
  std::uint64_t seed = 1;
  Duration length = std::chrono::minutes(30);  ///< at least 1 s
  Duration shown = std::chrono::seconds(60);   ///< of the beginning, kept datagram by datagram; at most `length`
};

struct PortraitWay {
  static constexpr std::int32_t kLost = -1;

  /// One-way delays of all that arrived, each datagram once, ascending.
  std::vector<Duration> delays;
  /// Per datagram of the time shown, one a millisecond: its delay [us], or kLost.
  std::vector<std::int32_t> shown;
  std::array<std::uint64_t, kOutcomes> fates{};  ///< of all that were sent

  /// The delay that a share q of the datagrams does not exceed: as the checks of profiles are counted. 0 of none.
  [[nodiscard]] Duration quantile(double q) const noexcept;
};

struct Portrait {
  Duration length{}, shown{};
  std::array<PortraitWay, kDirections> ways;  ///< up, down
  LinkSummary quality;
};

/// @param progress  told now and then which share is done, [0, 1]; false: enough, what was played so far is the portrait,
///                  with its own `length`; may be empty
/// @throws std::invalid_argument listing all problems of the link.
[[nodiscard]] Portrait portrait_of(const PortraitSetup& setup, const std::function<bool(double)>& progress = {});

}  // namespace tandem::netsim
