#include "netsim/engine/decision_log.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <tuple>

#include "common/base/rng.h"

namespace tandem::netsim {
namespace {

/// Sort key of DecisionLog::sorted.
auto rank(const Decision& d) { return std::tuple(d.in, d.link, d.flow, d.direction, d.index, d.copy); }

void append(std::int64_t value, std::string& text) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

void append_cause(const Decision& d, std::string& text) {
  const bool plain = d.outcome == Outcome::kDeliver;
  if (d.corruption.kind == Corruption::Kind::kNone) {
    text += plain ? "-" : name(d.outcome);
    return;
  }
  if (!plain) text.append(name(d.outcome)) += "; ";
  if (d.corruption.kind == Corruption::Kind::kTruncated) {
    text += "cut ";
    append(d.corruption.length, text);
    return;
  }
  text += "flipped ";
  append(d.corruption.bits, text);
  text += ' ';
  text += std::to_string(d.corruption.seed);
}

}  // namespace

void sort_decisions(std::vector<Decision>& rows) {
  std::ranges::stable_sort(rows, [](const Decision& a, const Decision& b) { return rank(a) < rank(b); });
}

std::vector<Decision> DecisionLog::take_before(Time until) {
  const auto kept =
      std::stable_partition(rows_.begin(), rows_.end(), [until](const Decision& d) { return d.in >= until; });
  std::vector<Decision> taken(kept, rows_.end());
  rows_.erase(kept, rows_.end());
  sort_decisions(taken);
  return taken;
}

std::vector<Decision> DecisionLog::sorted() const {
  std::vector<Decision> rows = rows_;
  sort_decisions(rows);
  return rows;
}

std::string_view decision_csv_header() noexcept {
  return "t_in_ns[ns],link[1],dir[1],flow[1],idx[1],size[B],verdict[1],t_out_ns[ns],cause[1]\n";
}

void append_csv(const Decision& d, std::string& text) {
  const auto number = [&text](auto value) {
    append(static_cast<std::int64_t>(value), text);
    text += ',';
  };
  number(d.in.time_since_epoch().count());
  number(d.link);
  text += name(d.direction);
  text += ',';
  number(d.flow);
  number(d.index);
  number(d.size);
  if (d.copy) text += "copy ";
  text += d.in_flight ? "waiting," : dropped(d.outcome) ? "dropped," : "delivered,";
  number(d.out.time_since_epoch().count());
  append_cause(d, text);
  text += '\n';
}

std::string decision_csv(std::span<const Decision> rows) {
  std::string text{decision_csv_header()};
  text.reserve(text.size() + rows.size() * 72);
  for (const Decision& row : rows) append_csv(row, text);
  return text;
}

std::uint64_t decision_hash(std::span<const Decision> rows) noexcept {
  std::uint64_t hash = 0;
  const auto add = [&hash](std::uint64_t value) { hash = mix64(hash ^ value); };
  for (const Decision& d : rows) {
    add(static_cast<std::uint64_t>(d.in.time_since_epoch().count()));
    add(static_cast<std::uint64_t>(d.out.time_since_epoch().count()));
    add(d.index);
    add(d.corruption.seed);
    add(std::uint64_t{d.corruption.bits} << 32 | d.corruption.length);
    add(std::uint64_t{d.link} << 32 | d.flow);
    add(std::uint64_t{d.size} << 32 | static_cast<std::uint64_t>(d.direction) << 16 |
        static_cast<std::uint64_t>(d.corruption.kind) << 24 | static_cast<std::uint64_t>(d.outcome) << 8 |
        (d.copy ? 2U : 0U) | (d.in_flight ? 1U : 0U));
  }
  return hash;
}

}  // namespace tandem::netsim
