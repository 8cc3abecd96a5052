#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/path_decision.h"
#include "netsim/models/corruption.h"
#include "netsim/models/path_spec.h"

/// Log of all decisions of a network, one row per datagram or copy. Logs can be inspected, compared byte by byte and
/// replayed (netsim/engine/replay.h). netsim/profiles/decision_csv.h reads the text form.
namespace tandem::netsim {

/// Final decision on one datagram or one copy.
struct Decision {
  Time in;                  ///< time of entering the network; copy: that of its original
  Time out;                 ///< due time at the receiver; dropped: time of the decision.
                            ///< A live proxy sends later than this, by its scheduling delay.
  std::uint64_t index = 0;  ///< index of the datagram on its path, from 0; copy: that of its original
  std::uint32_t link = 0;   ///< number of the link; a flow with its own link: number of the flow
  std::uint32_t flow = 0;   ///< client, in order of adding or arrival
  std::uint32_t size = 0;   ///< [bytes] as sent
  Direction direction = Direction::kUp;
  Outcome outcome = Outcome::kDeliver;  ///< kWaiting: undecided at the end of the log
  bool copy = false;                    ///< made by duplication
  bool in_flight = false;               ///< neither dropped nor delivered when the log ended; due at `out`
  Corruption corruption = {};           ///< difference between sent and delivered bytes

  friend bool operator==(const Decision&, const Decision&) = default;
};

/// Receiver of decisions. `decided` is called once per datagram and once per copy, as soon as the decision is final
/// (drop or delivery). Implementations run on the packet path: no heap, lock or clock.
class DecisionSink {
 public:
  virtual ~DecisionSink() = default;
  virtual void decided(const Decision& decision) noexcept TANDEM_REALTIME = 0;
};

class LinkMonitor;

/// Sink, monitor and identity of the decisions of one link direction. A null sink or monitor costs one comparison per
/// datagram.
struct DecisionTap {
  DecisionSink* sink = nullptr;
  LinkMonitor* monitor = nullptr;
  std::uint32_t link = 0, flow = 0;
  Direction direction = Direction::kUp;
};

/// Stores decisions in memory allocated by the constructor. Rows beyond the capacity are counted, not stored.
class DecisionLog final : public DecisionSink {
 public:
  explicit DecisionLog(std::size_t capacity) { rows_.reserve(capacity); }

  void decided(const Decision& decision) noexcept override {
    if (rows_.size() == rows_.capacity()) {
      ++missed_;
      return;
    }
    rows_.push_back(decision);
  }

  /// Allocates space for `more` further rows. Not for the packet path.
  void reserve(std::size_t more) { rows_.reserve(rows_.size() + more); }
  [[nodiscard]] std::size_t free_rows() const noexcept { return rows_.capacity() - rows_.size(); }
  [[nodiscard]] std::span<const Decision> rows() const noexcept { return rows_; }
  [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }
  void clear() noexcept { rows_.clear(); }

  /// Removes and returns the rows of datagrams that entered before `until`, in the order of `sorted`. Consecutive parts
  /// are in that order as a whole if no earlier datagram is still in flight.
  [[nodiscard]] std::vector<Decision> take_before(Time until);

  /// Returns the rows ordered by (in, link, flow, direction, index, copy). This order does not depend on the polling
  /// order.
  [[nodiscard]] std::vector<Decision> sorted() const;

 private:
  std::vector<Decision> rows_;
  std::uint64_t missed_ = 0;
};

/// Sorts decisions into the order of DecisionLog::sorted.
void sort_decisions(std::vector<Decision>& rows);

/// Returns the header line including line feed. Columns: t_in_ns, link, dir, flow, idx, size, verdict, t_out_ns, cause.
[[nodiscard]] std::string_view decision_csv_header() noexcept;

/// Appends one row to `text`. The verdict is `delivered`, `dropped` or `waiting` (in flight at the end), with the
/// prefix `copy ` for a copy. The cause combines the outcome's name and the corruption (`flipped BITS SEED`, `cut
/// LENGTH`), separated by `; `. The cause of a plain delivery is `-`.
void append_csv(const Decision& decision, std::string& text);

/// Returns header and rows, in the given order.
[[nodiscard]] std::string decision_csv(std::span<const Decision> rows);

/// Returns a 64-bit fingerprint of the rows in the given order. Tests use it to compare builds without files.
[[nodiscard]] std::uint64_t decision_hash(std::span<const Decision> rows) noexcept;

}  // namespace tandem::netsim
