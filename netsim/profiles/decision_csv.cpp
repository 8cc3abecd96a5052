#include "netsim/profiles/decision_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>

#include "common/base/csv.h"
#include "common/base/suggestions.h"
#include "netsim/profiles/table_errors.h"

namespace tandem::netsim {
namespace {

enum Column : std::size_t { kIn, kLink, kDirection, kFlow, kIndex, kSize, kVerdict, kOut, kCause, kColumns };
constexpr std::array<const char*, kColumns> kNames{"t_in_ns", "link",    "dir",      "flow", "idx",
                                                   "size",    "verdict", "t_out_ns", "cause"};

/// Parses the whole text as a number that is not negative. @return false if it is none
bool read_whole(std::string_view text, auto& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && !text.empty();
}

/// Parses `cut 12` or `flipped 3 1234567`.
bool read_damage(std::string_view text, Corruption& damage) {
  if (text.starts_with("cut ")) {
    damage.kind = Corruption::Kind::kTruncated;
    return read_whole(text.substr(4), damage.length);
  }
  if (!text.starts_with("flipped ")) return false;
  text.remove_prefix(8);
  const std::size_t space = text.find(' ');
  if (space == text.npos) return false;
  damage.kind = Corruption::Kind::kBitFlips;
  return read_whole(text.substr(0, space), damage.bits) && read_whole(text.substr(space + 1), damage.seed);
}

class DecisionCsvReader {
 public:
  DecisionCsvReader(const CsvTable& table, std::string_view file) : table_(table), errors_(file) {}

  std::expected<std::vector<Decision>, InputErrors> read() {
    for (std::size_t c = 0; c < kColumns; ++c) {
      if (const auto found = table_.find(kNames[c])) {
        column_[c] = *found;
      } else {
        errors_.add(1, 1, kNames[c], "", "this column of a decision log is missing");
      }
    }
    if (errors_.empty() && table_.rows() == 0) errors_.add("holds no decision");
    if (errors_.empty()) rows();
    if (!errors_.empty()) return errors_.take();
    return std::move(rows_);
  }

 private:
  void mistake(std::size_t row, Column c, std::string message) {
    errors_.add(table_, row, column_[c], std::move(message));
  }

  std::uint64_t whole(std::size_t row, Column c, std::uint64_t max) {
    std::uint64_t value = 0;
    if (read_whole(table_.cell(row, column_[c]), value) && value <= max) return value;
    mistake(row, c, "must be a whole number in [0, " + std::to_string(max) + "]");
    return 0;
  }

  void verdict_of(std::size_t row, Decision& d) {
    std::string_view verdict = table_.cell(row, column_[kVerdict]);
    if (verdict.starts_with("copy ")) {
      d.copy = true;
      verdict.remove_prefix(5);
    }
    d.in_flight = verdict == "waiting";
    if (verdict != "delivered" && verdict != "dropped" && verdict != "waiting") {
      return mistake(row, kVerdict, "must be delivered, dropped or waiting, `copy ` before it for a copy");
    }
    std::string_view cause = table_.cell(row, column_[kCause]);
    const std::size_t cut = cause.find("; ");
    const std::string_view damage = cut == cause.npos ? cause : cause.substr(cut + 2);
    if (read_damage(damage, d.corruption)) {
      if (cut == cause.npos) return checked(row, verdict, d);
      cause = cause.substr(0, cut);
    } else if (cut != cause.npos) {
      return mistake(row, kCause, "behind `; ` must be `flipped BITS SEED` or `cut LENGTH`");
    }
    std::vector<std::string> known{"-"};
    bool found = cause == "-";
    for (std::size_t i = 1; i < kOutcomes && !found; ++i) {
      d.outcome = static_cast<Outcome>(i);
      known.emplace_back(name(d.outcome));
      found = cause == known.back();
    }
    if (!found) return mistake(row, kCause, suggest(cause, known));
    checked(row, verdict, d);
  }

  void checked(std::size_t row, std::string_view verdict, const Decision& d) {
    const bool undecided = d.outcome == Outcome::kWaiting;
    if (dropped(d.outcome) != (verdict == "dropped") || (undecided && verdict != "waiting")) {
      mistake(row, kCause, "does not go with this verdict");
    }
  }

  void rows() {
    constexpr std::uint64_t kTime = std::uint64_t{1} << 62;
    constexpr std::uint64_t kNumber = std::numeric_limits<std::uint32_t>::max();
    rows_.reserve(table_.rows());
    for (std::size_t row = 0; row < table_.rows() && !errors_.full(); ++row) {
      Decision d;
      d.in = Time{Duration{static_cast<std::int64_t>(whole(row, kIn, kTime))}};
      d.out = Time{Duration{static_cast<std::int64_t>(whole(row, kOut, kTime))}};
      d.link = static_cast<std::uint32_t>(whole(row, kLink, kNumber));
      d.flow = static_cast<std::uint32_t>(whole(row, kFlow, kNumber));
      d.index = whole(row, kIndex, kTime);
      d.size = static_cast<std::uint32_t>(whole(row, kSize, kNumber));
      const std::string_view direction = table_.cell(row, column_[kDirection]);
      if (direction != "up" && direction != "down") mistake(row, kDirection, "must be up or down");
      d.direction = direction == "down" ? Direction::kDown : Direction::kUp;
      verdict_of(row, d);
      if (d.out < d.in) mistake(row, kOut, "is before t_in_ns");
      rows_.push_back(d);
    }
    if (!errors_.empty()) return;
    sort_decisions(rows_);
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      const Decision &a = rows_[i - 1], &b = rows_[i];
      if (a.in == b.in && a.link == b.link && a.flow == b.flow && a.direction == b.direction && a.index == b.index &&
          a.copy == b.copy) {
        errors_.add(0, 0, "idx", std::to_string(b.index),
                    "flow " + std::to_string(b.flow) + " " + name(b.direction) + " holds this datagram twice");
      }
    }
  }

  const CsvTable& table_;
  std::array<std::size_t, kColumns> column_{};
  std::vector<Decision> rows_;
  TableErrors errors_;
};

}  // namespace

std::expected<std::vector<Decision>, InputErrors> parse_decision_csv(std::string_view text,
                                                                     std::string_view file_name) {
  const auto table = CsvTable::parse(text);
  if (!table) {
    TableErrors errors{file_name};
    errors.add(table.error());
    return errors.take();
  }
  return DecisionCsvReader(*table, file_name).read();
}

}  // namespace tandem::netsim
