#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/io/text_layout.h"
#include "netsim/proxy/app/live_delay_histogram.h"
#include "netsim/proxy/app/proxy.h"
#include "netsim/proxy/app/proxy_status.h"

namespace tandem::netsim {

/// Live view of a running proxy: rate, delay and loss over about the last second, per client and direction. It also
/// shows the present queue wait and the datagrams in flight. It reads the published status and never blocks the packet
/// thread.
class ProxyStatusView {
 public:
  explicit ProxyStatusView(const Proxy& proxy) : proxy_(proxy) {}

  /// Takes a snapshot and discards those older than the last `kSnapshots`.
  void take_snapshot();

  /// Returns time, clients, rates and losses of both directions, and the proxy's lateness; empty before the first
  /// snapshot.
  [[nodiscard]] std::vector<io::ScreenItem> line() const;
  /// Returns a heading and two rows per client, each of at most `width` columns. Columns that do not fit are omitted at
  /// the right end. If clients exceed `rows`, the last row states how many are not shown.
  [[nodiscard]] std::vector<std::string> table(std::size_t rows, std::size_t width = 79) const;

 private:
  static constexpr std::size_t kSnapshots = 3;  ///< taken half a second apart
  using Directions = std::array<LiveDelayHistogram::Snapshot, kDirections>;
  struct Snapshot {
    ProxyStatus status;
    LiveDelayHistogram::Snapshot late;
    std::map<std::uint64_t, Directions> delays;  ///< by client number
  };
  [[nodiscard]] std::vector<std::string> row(const ProxyClientStatus& now, Direction direction,
                                             std::size_t address_width) const;

  const Proxy& proxy_;
  std::vector<Snapshot> snapshots_;  ///< oldest first
};

}  // namespace tandem::netsim
