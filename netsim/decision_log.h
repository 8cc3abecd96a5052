#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/damage.h"
#include "netsim/path_spec.h"
#include "netsim/verdict.h"

/// Every decision of a network as a row: what a network did can be looked at, compared byte by byte, and played again
/// (netsim/replay.h). The reader of the text is netsim/decision_csv.h.
namespace tandem::netsim {

/// The final fate of one datagram, or of one copy of it.
struct Decision {
  Time in;                  ///< of entering the network; a copy: of its original
  Time out;                 ///< due at the other end, as decided (a live proxy sends later, by its own lateness); dropped: when that was decided
  std::uint64_t index = 0;  ///< of the datagram on its path, from 0; a copy has that of its original
  std::uint32_t link = 0;   ///< the link it went over; flows with a link of their own: the flow's number
  std::uint32_t flow = 0;   ///< the client, in order of adding or arrival
  std::uint32_t size = 0;   ///< [bytes] as sent
  Direction direction = Direction::kUp;
  Outcome outcome = Outcome::kDeliver;  ///< or why it did not come out; kWaiting: the log ended before that was known
  bool copy = false;                    ///< made by duplication
  bool under_way = false;               ///< not dropped and not out when the log ended: it would come out at `out`
  Damage damage = {};                   ///< what came out is not what went in

  friend bool operator==(const Decision&, const Decision&) = default;
};

/// Where decisions go. Told once per datagram and once per copy, as soon as the fate is final: on dropping, or on being
/// handed over. Called on the packet path: no heap, lock or clock in there.
class DecisionSink {
 public:
  virtual ~DecisionSink() = default;
  virtual void decided(const Decision& decision) noexcept TANDEM_REALTIME = 0;
};

class LinkWatch;

/// Whose decisions they are; a sink or watch that is null costs one comparison per datagram.
struct DecisionTap {
  DecisionSink* sink = nullptr;
  LinkWatch* watch = nullptr;
  std::uint32_t link = 0, flow = 0;
  Direction direction = Direction::kUp;
};

/// Keeps decisions in memory that was taken beforehand; what does not fit is counted.
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

  /// Makes room for so many more; not on the packet path.
  void reserve(std::size_t more) { rows_.reserve(rows_.size() + more); }
  [[nodiscard]] std::size_t room() const noexcept { return rows_.capacity() - rows_.size(); }
  [[nodiscard]] std::span<const Decision> rows() const noexcept { return rows_; }
  [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }
  void clear() noexcept { rows_.clear(); }

  /// Takes out the rows of datagrams that entered before `until`, in the order of `sorted`: pieces of a file, one after
  /// the other, are then in that order as a whole, if nothing that entered earlier is still under way.
  [[nodiscard]] std::vector<Decision> take_before(Time until);

  /// The rows in the one order that says nothing about who was polled when: (in, link, flow, direction, index, copy).
  [[nodiscard]] std::vector<Decision> sorted() const;

 private:
  std::vector<Decision> rows_;
  std::uint64_t missed_ = 0;
};

/// Puts decisions into the order of DecisionLog::sorted.
void sort_decisions(std::vector<Decision>& rows);

/// First line of the text, with its line feed. Columns: t_in_ns, link, dir, flow, idx, size, verdict, t_out_ns, cause.
[[nodiscard]] std::string_view decision_csv_header() noexcept;

/// Appends one row. Verdict: `delivered`, `dropped` or `waiting` (under way at the end), `copy ` before it for a copy;
/// cause: the name of the outcome, what was done to the bytes (`flipped BITS SEED`, `cut LENGTH`), both with `; `
/// between them, `-` for plain delivery.
void append_csv(const Decision& decision, std::string& text);

/// Header and rows, in the order given.
[[nodiscard]] std::string decision_csv(std::span<const Decision> rows);

/// A 64-bit fingerprint of rows, in the order given; for tests that compare builds without files.
[[nodiscard]] std::uint64_t decision_hash(std::span<const Decision> rows) noexcept;

}  // namespace tandem::netsim
