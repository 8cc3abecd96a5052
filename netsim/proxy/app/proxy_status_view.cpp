#include "netsim/proxy/app/proxy_status_view.h"

#include <algorithm>
#include <utility>

#include "common/base/format.h"
#include "netsim/proxy/app/proxy_report.h"

namespace tandem::netsim {
namespace {

double as_double(std::uint64_t n) { return static_cast<double>(n); }
double ms(Duration d) { return seconds(d) * 1e3; }

double per_second(std::uint64_t now, std::uint64_t before, double s) { return s > 0 ? as_double(now - before) / s : 0; }

/// Returns the percentage of datagrams dropped by the network since `before`.
double lost_percent(const PathCounters& now, const PathCounters& before) {
  const std::uint64_t in = now.in - before.in;
  return in > 0 ? 100 * as_double(now.dropped() - before.dropped()) / as_double(in) : 0;
}

/// Formats a number; wide numbers lose their decimals so that the column width stays.
std::string fixed(double value, int width, int decimals) {
  std::string text = format("%*.*f", width, decimals, value);
  if (text.size() > static_cast<std::size_t>(width)) text = format("%*.0f", width, value);
  if (text.size() > static_cast<std::size_t>(width)) text = std::string(static_cast<std::size_t>(width), '#');
  return text;
}

/// Joins as many cells from the left as fit.
std::string fitted(const std::vector<std::string>& cells, std::size_t width) {
  std::string line;
  for (const std::string& cell : cells) {
    if (line.size() + cell.size() > width) break;
    line += cell;
  }
  return line;
}

constexpr std::size_t kAddressWidth = 21;  // IPv4 address and port

}  // namespace

void ProxyStatusView::take_snapshot() {
  if (snapshots_.size() == kSnapshots) snapshots_.erase(snapshots_.begin());
  Snapshot& snapshot = snapshots_.emplace_back();
  snapshot.status = proxy_.status();
  proxy_.sender().live_lateness().read(snapshot.late);
  for (std::size_t i = 0; i < snapshot.status.clients; ++i) {
    const ProxyClientStatus& client = snapshot.status.client[i];
    Directions& directions = snapshot.delays[client.number];
    for (const Direction d : {Direction::kUp, Direction::kDown}) {
      proxy_.delays().of(client.place, d).read(directions[static_cast<std::size_t>(d)]);
    }
  }
}

std::vector<io::ScreenItem> ProxyStatusView::line() const {
  if (snapshots_.empty()) return {};
  const ProxyStatus& now = snapshots_.back().status;
  const ProxyStatus& before = snapshots_.front().status;
  const double s = seconds(now.since_start - before.since_start);
  std::vector<io::ScreenItem> items;
  const auto add = [&](std::string text) { items.push_back({std::move(text), "", 0}); };
  add(format("%.0f s, %llu client%s", seconds(now.since_start), static_cast<unsigned long long>(now.clients),
             now.clients == 1 ? "" : "s"));
  for (std::size_t d = 0; d < kDirections; ++d)
    add(format("%s %.0f/s lost %.1f %%", name(static_cast<Direction>(d)),
               per_second(now.total[d].in, before.total[d].in, s), lost_percent(now.total[d], before.total[d])));
  add(format("late p99 %.2f ms", ms(snapshots_.back().late.quantile_since(snapshots_.front().late, 0.99))));
  return items;
}

std::vector<std::string> ProxyStatusView::table(std::size_t rows, std::size_t width) const {
  std::vector<std::string> lines;
  if (snapshots_.empty() || rows < 2) return lines;
  const ProxyStatus& now = snapshots_.back().status;
  const bool all = 1 + kDirections * now.clients <= rows;
  const std::uint64_t shown = all ? now.clients : (rows - 2) / kDirections;
  std::size_t address = kAddressWidth;
  for (std::uint64_t i = 0; i < shown; ++i) address = std::max(address, io::to_text(now.client[i].address).size());
  lines.push_back(fitted({"  n ", format("%-*s ", static_cast<int>(address), "address"), "dir ", "   in/s", "  out/s",
                          " mean ms", "    p99", "  queue", " lost%", " flight"},
                         width));
  for (std::uint64_t i = 0; i < shown; ++i)
    for (const Direction d : {Direction::kUp, Direction::kDown})
      lines.push_back(fitted(row(now.client[i], d, address), width));
  if (!all) lines.push_back(format("  and %llu more", static_cast<unsigned long long>(now.clients - shown)));
  return lines;
}

std::vector<std::string> ProxyStatusView::row(const ProxyClientStatus& now, Direction direction,
                                              std::size_t address_width) const {
  const auto d = static_cast<std::size_t>(direction);
  // Oldest snapshot that contains this client.
  const Snapshot* before = &snapshots_.back();
  const ProxyClientStatus* then = &now;
  for (const Snapshot& snapshot : snapshots_) {
    const auto end = snapshot.status.client.begin() + static_cast<std::ptrdiff_t>(snapshot.status.clients);
    const auto found = std::ranges::find(snapshot.status.client.begin(), end, now.number, &ProxyClientStatus::number);
    if (found == end) continue;
    before = &snapshot;
    then = &*found;
    break;
  }
  const double s = seconds(snapshots_.back().status.since_start - before->status.since_start);
  const LiveDelayHistogram::Snapshot& delays = snapshots_.back().delays.at(now.number)[d];
  const LiveDelayHistogram::Snapshot& delays_then = before->delays.at(now.number)[d];
  const PathCounters& c = now.counters[d];
  const bool first = direction == Direction::kUp;
  return {format("%3s ", first ? std::to_string(now.number).c_str() : ""),
          format("%-*s ", static_cast<int>(address_width), first ? io::to_text(now.address).c_str() : ""),
          format("%-4s", name(direction)),
          " " + fixed(per_second(c.in, then->counters[d].in, s), 6, 0),
          " " + fixed(per_second(c.out, then->counters[d].out, s), 6, 0),
          " " + fixed(ms(delays.mean_since(delays_then)), 7, 2),
          " " + fixed(ms(delays.quantile_since(delays_then, 0.99)), 6, 2),
          " " + fixed(ms(now.queue[d]), 6, 2),
          " " + fixed(lost_percent(c, then->counters[d]), 5, 2),
          " " + fixed(as_double(c.in_flight()), 6, 0)};
}

}  // namespace tandem::netsim
