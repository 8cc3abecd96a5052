#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/shared_recording.h"

/// Specifications of the loss models. Models are independent; a datagram is lost if at least one model loses it.
namespace tandem::netsim {

/// Continuous-time Gilbert-Elliott: good and bad periods of exponential length alternate in time, independent of the
/// packet rate. Share of bad time = bad_mean / (good_mean + bad_mean).
struct BadPeriodsSpec {
  Duration good_mean{};  ///< [1 us, 1 h]
  Duration bad_mean{};   ///< [1 us, 1 h]
  double loss_good = 0;  ///< loss probability of a datagram sent in a good period [0, 1]
  double loss_bad = 1;   ///< loss probability of a datagram sent in a bad period [0, 1]

  friend bool operator==(const BadPeriodsSpec&, const BadPeriodsSpec&) = default;
};

/// Gilbert-Elliott per datagram: the state changes before every datagram, and the new state decides. Bad periods get
/// shorter at higher packet rates; prefer BadPeriodsSpec unless a paper gives numbers per packet. Share of bad = p / (p
/// + r); loss = ((1 - k) r + (1 - h) p) / (p + r); runs of bad have mean length 1 / r.
struct GilbertElliottSpec {
  double p = 0;  ///< transition good to bad, per datagram (0, 1]
  double r = 1;  ///< transition bad to good (0, 1]; with 0 a bad run would never end
  double h = 0;  ///< probability that a datagram passes in the bad state [0, 1]
  double k = 1;  ///< probability that a datagram passes in the good state [0, 1]; at least h

  friend bool operator==(const GilbertElliottSpec&, const GilbertElliottSpec&) = default;
};

/// netem's `loss state` (general and intuitive) model. State 1 passes in a gap, 2 passes in a burst, 3 loses in a
/// burst, 4 loses a single datagram in a gap. The state changes before every datagram, and the new state decides;
/// the initial state is 1.
/// Source: Linux, sch_netem.c, loss_4state [Salsano et al. 2012, definition of a general and intuitive loss
/// model].
struct FourStateSpec {
  double p13 = 0, p31 = 1, p32 = 0, p23 = 1,
         p14 = 0;  ///< [0, 1]; p13 + p14 <= 1, p31 + p32 <= 1; every reachable state needs a way back

  friend bool operator==(const FourStateSpec&, const FourStateSpec&) = default;
};

/// Loss bursts that begin as a Poisson process in time; datagrams sent during a burst are lost. Of overlapping bursts
/// the longer one counts. In milliseconds the lost share is 1 - exp(-rate mean length), independent of the traffic.
struct LossBurstsSpec {
  /// Distribution of the burst length.
  enum class Law : std::uint8_t {
    kFixed,      ///< `length`
    kGeometric,  ///< mean `length`; in milliseconds the continuous form, the exponential
    kParetoII,   ///< `length` (u^(-1/alpha) - 1): Lomax of scale `length`; in datagrams rounded up
  };
  /// Unit of `length` and `cap`.
  enum class Unit : std::uint8_t { kDatagrams, kMilliseconds };
  double rate_per_s = 0;  ///< (0, 1000]; in milliseconds, rate times cap is at most 32
  Law law = Law::kFixed;
  Unit unit = Unit::kDatagrams;
  double length = 1;  ///< in datagrams: at least 1, whole if kFixed; in ms: above 0. At most `cap`
  double alpha = 1;   ///< kParetoII [0.1, 100]
  double cap = 1;     ///< longest burst, in the same unit (0, 1e5]

  friend bool operator==(const LossBurstsSpec&, const LossBurstsSpec&) = default;
};

/// Loss with exact counts or positions, for tests. A part is off when it is 0 or empty.
struct LossPatternSpec {
  std::uint32_t lost = 0, of = 0;           ///< exactly `lost` of every `of` datagrams, at random positions; lost <= of
  std::uint32_t every = 0;                  ///< every n-th datagram: indices n - 1, 2 n - 1, ...
  std::vector<std::uint64_t> indices = {};  ///< indices of lost datagrams, from 0, ascending, at most 4096
  std::vector<Duration> times = {};  ///< loses the first datagram sent at or after each time; ascending, at most 4096

  friend bool operator==(const LossPatternSpec&, const LossPatternSpec&) = default;
};

/// Congestion loss: depends on the queue that a datagram finds, or on a stall.
struct CongestionLossSpec {
  Duration wait_low{};   ///< no loss for waits up to this [0, 1 h]
  Duration wait_high{};  ///< loss rises linearly to `probability` at this wait and stays there; above wait_low, or both
                         ///< 0: off
  double probability = 0;  ///< [0, 1]
  double in_stall = 0;     ///< loss probability of a datagram that would leave during a stall [0, 1]

  friend bool operator==(const CongestionLossSpec&, const CongestionLossSpec&) = default;
};

/// Recorded loss. The recording repeats after its end.
struct LossTrace {
  std::vector<bool> lost = {};  ///< [1, 1e7] entries
  Duration interval{};          ///< time per entry, starting at Time{} [1 us, 1 h]; 0: one entry per datagram

  friend bool operator==(const LossTrace&, const LossTrace&) = default;
};

/// All loss models of one direction; absent members are off.
struct LossSpec {
  double probability = 0;  ///< Bernoulli, per datagram [0, 1]
  std::optional<BadPeriodsSpec> periods = {};
  std::optional<GilbertElliottSpec> gilbert_elliott = {};
  std::optional<FourStateSpec> four_state = {};
  std::optional<LossBurstsSpec> bursts = {};
  std::optional<LossPatternSpec> pattern = {};
  std::optional<CongestionLossSpec> congestion = {};
  SharedRecording<LossTrace> trace = {};  ///< null: none

  friend bool operator==(const LossSpec&, const LossSpec&) = default;
};

}  // namespace tandem::netsim
