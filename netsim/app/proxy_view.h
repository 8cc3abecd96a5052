#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/io/text_layout.h"
#include "netsim/app/live_delays.h"
#include "netsim/app/proxy.h"
#include "netsim/app/proxy_status.h"

namespace tandem::netsim {

/// What a running proxy does now, for people: rate, delay and loss over about the last second, and the queue of the
/// rate and what is under way now, per client and direction. Reads what the packet thread publishes; never makes it wait.
class ProxyView {
 public:
  explicit ProxyView(const Proxy& proxy) : proxy_(proxy) {}

  /// Takes a new picture; the ones before the last `kPictures` are forgotten.
  void look();

  /// Time, clients, rates and losses of both directions, and the proxy's own lateness; nothing before the first look.
  [[nodiscard]] std::vector<io::ScreenItem> line() const;
  /// A heading, then two rows per client, of at most `width` columns each: whole columns at the right end are left out where they do not fit. At
  /// most `rows` rows, the last of which says how many clients are not shown.
  [[nodiscard]] std::vector<std::string> table(std::size_t rows, std::size_t width = 79) const;

 private:
  static constexpr std::size_t kPictures = 3;  ///< half a second apart
  using Lanes = std::array<LiveDelays::Picture, kDirections>;
  struct Picture {
    ProxyStatus status;
    LiveDelays::Picture late;
    std::map<std::uint64_t, Lanes> delays;  ///< by client's number
  };
  [[nodiscard]] std::vector<std::string> row(const ProxyClientStatus& now, Direction direction, std::size_t address_width) const;

  const Proxy& proxy_;
  std::vector<Picture> pictures_;  ///< oldest first
};

}  // namespace tandem::netsim
