#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/time.h"

/// How datagrams get lost, as plain numbers. Every model decides for itself; one of them is enough to lose a datagram.
namespace tandem::netsim {

/// Continuous-time Gilbert-Elliott: good and bad periods of exponential length alternate in time, whatever the packet
/// rate. Share of bad time = bad_mean / (good_mean + bad_mean).
struct BadPeriodsSpec {
  Duration good_mean{};  ///< [1 us, 1 h]
  Duration bad_mean{};   ///< [1 us, 1 h]
  double loss_good = 0;  ///< probability of losing a datagram sent in a good period [0, 1]
  double loss_bad = 1;   ///< the same in a bad period [0, 1]

  friend bool operator==(const BadPeriodsSpec&, const BadPeriodsSpec&) = default;
};

/// Gilbert-Elliott counted in datagrams: the state changes before every datagram, and the new state decides. Its bad
/// times get shorter when more is sent; prefer BadPeriodsSpec unless a paper gives numbers per packet.
/// Share of bad = p / (p + r); loss = ((1 - k) r + (1 - h) p) / (p + r); runs of bad have mean length 1 / r.
struct GilbertElliottSpec {
  double p = 0;  ///< good to bad, per datagram (0, 1]
  double r = 1;  ///< bad to good (0, 1]; 0 would never end
  double h = 0;  ///< probability that a datagram passes in the bad state [0, 1]
  double k = 1;  ///< the same in the good state [0, 1]; not below h

  friend bool operator==(const GilbertElliottSpec&, const GilbertElliottSpec&) = default;
};

/// netem's `loss state`, general and intuitive: 1 passes in a gap, 2 passes in a burst, 3 loses in a burst, 4 loses one
/// alone in a gap. The state changes before every datagram, and the new state decides; the first one starts from 1.
/// Source: Linux, sch_netem.c, loss_4state [Salsano et al. 2012, definition of a general and intuitive loss model].
struct FourStateSpec {
  double p13 = 0, p31 = 1, p32 = 0, p23 = 1,
         p14 = 0;  ///< [0, 1]; p13 + p14 <= 1, p31 + p32 <= 1; no way without return

  friend bool operator==(const FourStateSpec&, const FourStateSpec&) = default;
};

/// Bursts begin as a Poisson process in time; what is sent in one is lost. Overlapping ones: the longer counts.
/// In milliseconds the lost share is 1 - exp(-rate mean length), whatever is sent.
struct LossBurstsSpec {
  enum class Law : std::uint8_t {
    kFixed,      ///< `length`
    kGeometric,  ///< mean `length`; in milliseconds its continuous form, the exponential
    kParetoII,   ///< length (u^(-1/alpha) - 1): Lomax of scale `length`; in datagrams rounded up
  };
  enum class Unit : std::uint8_t { kDatagrams, kMilliseconds };
  double rate_per_s = 0;  ///< (0, 1000]; in milliseconds rate times cap at most 32
  Law law = Law::kFixed;
  Unit unit = Unit::kDatagrams;
  double length = 1;  ///< [datagrams: whole when fixed, at least 1; or ms, above 0], at most `cap`
  double alpha = 1;   ///< kParetoII [0.1, 100]
  double cap = 1;     ///< longest burst, the same unit (0, 1e5]

  friend bool operator==(const LossBurstsSpec&, const LossBurstsSpec&) = default;
};

/// Loss to count on, for tests. A part is off when 0 or empty.
struct LossPatternSpec {
  std::uint32_t lost = 0, of = 0;           ///< exactly `lost` of every `of` datagrams, at drawn places; lost <= of
  std::uint32_t every = 0;                  ///< every n-th: the datagrams n - 1, 2 n - 1, ...
  std::vector<std::uint64_t> indices = {};  ///< these datagrams, counted from 0, ascending, at most 4096
  std::vector<Duration> times = {};         ///< the first datagram sent at or after each, ascending, at most 4096

  friend bool operator==(const LossPatternSpec&, const LossPatternSpec&) = default;
};

/// Loss that comes with delay: of what finds a queue, and of what meets a stall.
struct CongestionLossSpec {
  Duration wait_low{};     ///< no loss for a wait up to this [0, 1 h],
  Duration wait_high{};    ///< linear up to `probability` at this and above; above wait_low, or both 0: off
  double probability = 0;  ///< [0, 1]
  double in_stall = 0;     ///< of what would leave during a stall [0, 1]

  friend bool operator==(const CongestionLossSpec&, const CongestionLossSpec&) = default;
};

/// Recorded loss, from the start again after its end.
struct LossTrace {
  std::vector<bool> lost = {};  ///< [1, 1e7] entries
  Duration interval{};          ///< time per entry from Time{} [1 us, 1 h]; 0: one entry per datagram

  friend bool operator==(const LossTrace&, const LossTrace&) = default;
};

struct LossSpec {
  double probability = 0;  ///< Bernoulli, per datagram [0, 1]
  std::optional<BadPeriodsSpec> periods = {};
  std::optional<GilbertElliottSpec> gilbert_elliott = {};
  std::optional<FourStateSpec> four_state = {};
  std::optional<LossBurstsSpec> bursts = {};
  std::optional<LossPatternSpec> pattern = {};
  std::optional<CongestionLossSpec> congestion = {};
  std::shared_ptr<const LossTrace> trace = {};  ///< null: none

  friend bool operator==(const LossSpec&, const LossSpec&) = default;
};

}  // namespace tandem::netsim
