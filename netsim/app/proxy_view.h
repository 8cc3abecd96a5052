#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "netsim/app/live_delays.h"
#include "netsim/app/proxy.h"
#include "netsim/app/proxy_status.h"

namespace tandem::netsim {

/// The proxy's state and its own lateness in at most 79 columns: a long line loses decimals, then the lateness, never a
/// unit of what it says.
[[nodiscard]] std::string in_one_line(const std::string& state, double late_p99_ms);

/// What a running proxy does now, for people: rate, delay and loss over about the last second, and the queue of the
/// rate and what is under way now, per client and direction. Reads what the packet thread publishes; never makes it wait.
class ProxyView {
 public:
  explicit ProxyView(const Proxy& proxy) : proxy_(proxy) {}

  /// Takes a new picture; the ones before the last `kPictures` are forgotten.
  void look();

  /// All in one line of at most 79 columns.
  [[nodiscard]] std::string line() const;
  /// A heading, then two rows per client, of at most 79 columns each; at most `rows` rows, the last of which says how
  /// many are not shown.
  [[nodiscard]] std::vector<std::string> table(std::size_t rows) const;

 private:
  static constexpr std::size_t kPictures = 3;  ///< half a second apart
  using Lanes = std::array<LiveDelays::Picture, kDirections>;
  struct Picture {
    ProxyStatus status;
    LiveDelays::Picture late;
    std::map<std::uint64_t, Lanes> delays;  ///< by client's number
  };
  [[nodiscard]] std::string row(const ProxyClientStatus& now, Direction direction) const;

  const Proxy& proxy_;
  std::vector<Picture> pictures_;  ///< oldest first
};

}  // namespace tandem::netsim
