#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/engine/decision_log.h"
#include "netsim/engine/network.h"
#include "netsim/proxy/proxy_core.h"

/// Decision logs of networks under seeded traffic, for tests that compare logs within one build or between builds.
namespace tandem::netsim::test {

/// Traffic of one link, in both directions: period, random shift and size of each datagram.
struct Traffic {
  Duration period{1'000'000};
  Duration moved{300'000};  ///< random shift in [0, moved]; below `period`
  std::size_t size_min = 16, size_max = 300;
  Duration length{5'000'000'000};
  std::uint64_t seed = 1;
};

/// Sends `traffic[i]` into link i and delivers the datagrams as time advances.
/// @return the sorted log, including datagrams in flight at the end
[[nodiscard]] std::vector<Decision> log_of(Network& network, const std::vector<Traffic>& traffic);
/// The same through a proxy core, which must have no clients yet.
[[nodiscard]] std::vector<Decision> log_of(ProxyCore& core, const std::vector<Traffic>& traffic);

/// Returns empty if two logs are equal byte for byte; else the first line that differs, from both.
[[nodiscard]] std::string difference(const std::vector<Decision>& a, const std::vector<Decision>& b);

/// Returns the rows of one flow.
[[nodiscard]] std::vector<Decision> of_flow(const std::vector<Decision>& rows, std::uint32_t flow);

/// Path with deferred verdicts and changed bytes: drop-head queue, outages that keep the newest, flipped bits,
/// fragments. Also copies, reordering and loss.
[[nodiscard]] PathSpec late_decisions();

/// Network of the fixed matrix.
struct MatrixEntry {
  std::string name;
  std::function<std::vector<Decision>()> log;
};
/// Returns the networks that verify "same seed, same decisions on every build". They cover every shipped profile
/// without a user file, all models at once, changes, addresses, replay and shared queues.
[[nodiscard]] std::vector<MatrixEntry> decision_matrix();

}  // namespace tandem::netsim::test
