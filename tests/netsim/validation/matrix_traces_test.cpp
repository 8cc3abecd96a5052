// Row "profiles" of the validation matrix: generated networks against recordings of real ones. Files beside each
// recording (net_*.md) describe its origin and permitted comparisons.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "netsim/profiles/profile_loader.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/support.h"
#include "tests/netsim/validation/statistics.h"

namespace tandem::netsim {
namespace {

using namespace test;

struct Exchanges {
  std::vector<double> sent_ms, rtt_ms;
};

constexpr const char* kNoRecordings =
    "TANDEM_TRACES, the folder of the shared recordings, is not set (./test --traces DIR)";

/// Returns a recording from the folder TANDEM_TRACES.
Exchanges recorded(const std::string& name) {
  std::ifstream file(std::string(std::getenv("TANDEM_TRACES")) + "/" + name, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  std::string line;
  std::getline(text, line);
  std::vector<std::string> header;
  for (std::stringstream cells(line); std::getline(cells, line, ',');) header.push_back(line);
  Exchanges all;
  while (std::getline(text, line)) {
    std::stringstream cells(line);
    std::string cell;
    for (std::size_t i = 0; std::getline(cells, cell, ',') && i < header.size(); ++i) {
      if (header[i].starts_with("t_send_s")) all.sent_ms.push_back(1e3 * std::stod(cell));
      if (header[i].starts_with("rtt_ms")) all.rtt_ms.push_back(std::stod(cell));
    }
  }
  EXPECT_GT(all.rtt_ms.size(), 1000U) << name;
  return all;
}

/// Returns the exchanges over both directions of a profile for 30 virtual minutes. One starts every `interval`,
/// independent of earlier replies, so that time is sampled evenly. Lost exchanges are omitted, as in a recording of
/// replies.
Exchanges generated(const std::string& profile_name, Duration interval, std::uint64_t seed) {
  const auto profile = shipped_profile(profile_name);
  if (!profile) throw std::runtime_error(to_text(profile.error()));
  Path up{profile->link.up, Path::keys_for(seed, 0, Direction::kUp)};
  Path down{profile->link.down, Path::keys_for(seed, 0, Direction::kDown)};
  Exchanges all;
  for (Time now{}; now < Time{30min}; now += interval) {
    const PathDecision request = up.send(now, kSize);
    if (dropped(request.outcome)) continue;
    const PathDecision answer = down.send(request.at, kSize);
    if (dropped(answer.outcome)) continue;
    all.sent_ms.push_back(1e3 * seconds(now.time_since_epoch()));
    all.rtt_ms.push_back(1e3 * seconds(answer.at - now));
  }
  return all;
}

void expect_quantiles(Exchanges ours, Exchanges theirs) {
  for (const auto& [q, within] : {std::pair{0.50, 0.2}, {0.95, 0.2}, {0.99, 0.5}}) {
    const double a = quantile_of(ours.rtt_ms, q), b = quantile_of(theirs.rtt_ms, q);
    std::printf("[          ] p%.0f: generated %.2f ms, recorded %.2f ms, ln ratio %+.3f (at most %.1f)\n", 100 * q, a,
                b, std::log(a / b), within);
    EXPECT_LT(std::abs(std::log(a / b)), within) << "p" << 100 * q;
  }
}

/// Returns the correlation of rank-Gaussian round trips of exchanges sent `lag_ms` apart, within half a step.
double correlation_after(const Exchanges& all, double lag_ms) {
  const auto z = rank_gaussian(all.rtt_ms);
  std::vector<double> x, y;
  for (std::size_t i = 0, j = 0; i < z.size(); ++i) {
    while (j < z.size() && all.sent_ms[j] < all.sent_ms[i] + lag_ms - 8) ++j;
    if (j == z.size()) break;
    if (all.sent_ms[j] > all.sent_ms[i] + lag_ms + 8) continue;  // a pause of the recording
    x.push_back(z[i]);
    y.push_back(z[j]);
  }
  return correlation(x, y);
}

TEST(Matrix, MatchesTheRecordedRobotWithWifiGood) {
  if (std::getenv("TANDEM_TRACES") == nullptr) GTEST_SKIP() << kNoRecordings;
  const Exchanges theirs = recorded("net_wifi_static_robot_rtt.csv");
  ASSERT_FALSE(theirs.rtt_ms.empty());
  // The recording has no times. Its exchanges count as evenly spaced in time, as when the profile was fitted. Back to
  // back they would cover 79 s with 20 % stalls, which is no good Wi-Fi.
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed)
    expect_quantiles(generated("wifi-good", 10ms, seed), theirs);
}

TEST(Matrix, MatchesTheRecordedDriveWithFiveG) {
  if (std::getenv("TANDEM_TRACES") == nullptr) GTEST_SKIP() << kNoRecordings;
  const Exchanges theirs = recorded("net_5g_n78_urban_rtt_60hz.csv");
  ASSERT_FALSE(theirs.rtt_ms.empty());
  const Exchanges ours = generated("5g", 16ms, 1);
  expect_quantiles(ours, theirs);
  for (const double lag_ms : {16.0, 80.0, 160.0}) {
    const double a = correlation_after(ours, lag_ms), b = correlation_after(theirs, lag_ms);
    std::printf("[          ] correlation after %.0f ms: generated %.3f, recorded %.3f\n", lag_ms, a, b);
    EXPECT_NEAR(a, b, 0.15) << lag_ms;
  }
}

}  // namespace
}  // namespace tandem::netsim
