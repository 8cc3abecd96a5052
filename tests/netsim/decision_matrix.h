#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/decision_log.h"
#include "netsim/network.h"
#include "netsim/proxy_core.h"

/// Logs of networks under traffic that is fixed by a seed: for tests that compare them, in one build or between builds.
namespace tandem::netsim::test {

/// What is sent into one link: datagrams so far apart, in both directions, each moved and sized by a draw of its own.
struct Traffic {
  Duration period{1'000'000};
  Duration moved{300'000};  ///< [0, moved] later than its turn; below `period`
  std::size_t size_min = 16, size_max = 300;
  Duration length{5'000'000'000};
  std::uint64_t seed = 1;
};

/// Sends `traffic[i]` into link i and hands everything over as time goes on.
/// @return the log, sorted, with what was under way at the end
[[nodiscard]] std::vector<Decision> log_of(Network& network, const std::vector<Traffic>& traffic);
/// The same through a proxy's core; it has no clients yet.
[[nodiscard]] std::vector<Decision> log_of(ProxyCore& core, const std::vector<Traffic>& traffic);

/// Empty if two logs are the same, byte for byte; else the first line that differs, as both have it.
[[nodiscard]] std::string difference(const std::vector<Decision>& a, const std::vector<Decision>& b);

/// The rows of one flow.
[[nodiscard]] std::vector<Decision> of_flow(const std::vector<Decision>& rows, std::uint32_t flow);

/// What is decided late or changes bytes: a queue that drops at its head, outages that keep the newest, flipped bits,
/// fragments; beside copies, order and loss.
[[nodiscard]] PathSpec late_decisions();

/// One network of the fixed matrix.
struct MatrixEntry {
  std::string name;
  std::function<std::vector<Decision>()> log;
};
/// Every shipped profile that needs no file of the user, every model at once, changes, addresses, replay, shared
/// stores: what the promise "same seed, same decisions on every build" is held to.
[[nodiscard]] std::vector<MatrixEntry> decision_matrix();

}  // namespace tandem::netsim::test
