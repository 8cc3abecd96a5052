// Metrics of a session's links, in virtual time.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/server/app/monitor/idle_server.h"
#include "tests/sim/hosted_hands.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;

struct Records {
  server::TickQueue records{64};
};
/// A session with hands, and the metrics page of its server.
struct MonitoredHands : private Records, test::HostedHands {
  MonitoredHands() : HostedHands(records) {
    hosted.set_recorded(false);
    server.registry.add({.name = "lesson", .id = kId, .code = {}, .session = &hosted});
    while (now < Time{} + 3s && !begun()) step();
    EXPECT_TRUE(begun());
  }
  /// Value of a metric after enough ticks for the next status.
  double read(const std::string& metric) {
    for (int tick = 0; tick < 128; ++tick) step();
    return shown(metric);
  }
  [[nodiscard]] double shown(const std::string& metric) const {
    const std::string page = server.page("/metrics", nullptr).body;
    const std::size_t at = page.find("\n" + metric + " ");
    if (at == std::string::npos) throw std::runtime_error("no " + metric + " in " + page);
    return std::stod(page.substr(at + metric.size() + 2));
  }
  [[nodiscard]] std::string of_first_seat(const std::string& name, const std::string& label = {}) const {
    return name + "{session=\"lesson\",seat=\"" + scene.seats[0].name + "\"" + label + "}";
  }
  /// The next datagrams of the first hand arrive damaged.
  void damage(int count) {
    up = [this, count](std::size_t i, std::span<std::byte> bytes) mutable {
      if (i == 0 && count-- > 0) bytes.back() ^= std::byte{1};
      arrive(i, bytes);
    };
  }

  static constexpr auth::Id16 kId{std::byte{1}};
  server::test::IdleServer server;
};

constexpr const char* kTag = "tandem_udp_drop_total{reason=\"tag\"}";
constexpr const char* kStray = "tandem_udp_drop_total{reason=\"stray\"}";

TEST(SessionMetrics, LossDoesNotFallWhenADatagramComesLate) {
  MonitoredHands life;
  const std::string lost = life.of_first_seat("tandem_udp_lost_total");
  const std::string late = life.of_first_seat("tandem_udp_late_total");
  ASSERT_EQ(life.read(lost), 0);
  std::vector<std::byte> held;
  life.up = [&](std::size_t i, std::span<std::byte> bytes) {
    if (i == 0 && held.empty()) return held.assign(bytes.begin(), bytes.end());
    life.arrive(i, bytes);
  };
  EXPECT_EQ(life.read(lost), 1);
  life.arrive(0, held);
  EXPECT_EQ(life.read(late), 1);
  EXPECT_EQ(life.shown(lost), 1);
  life.join(0);
  EXPECT_EQ(life.read(lost), 0) << "another connection";
}

TEST(SessionMetrics, RejectedDatagramsStayCountedWhenASeatIsTakenAgain) {
  MonitoredHands life;
  life.damage(7);
  EXPECT_EQ(life.read(kTag), 7);
  life.join(0);
  EXPECT_EQ(life.read(kTag), 7);
  life.damage(3);
  EXPECT_EQ(life.read(kTag), 10);
  EXPECT_EQ(life.shown("tandem_aead_fail_total"), 10);
}

TEST(SessionMetrics, RejectedDatagramsStayCountedWhenASessionIsRemoved) {
  MonitoredHands life;
  life.damage(7);
  for (int n = 0; n < 5; ++n) life.arrive(0, std::array<std::byte, 40>{});
  EXPECT_EQ(life.read(kTag), 7);
  EXPECT_EQ(life.shown(kStray), 5);
  life.hosted.finish(life.now, {});
  life.server.registry.remove(MonitoredHands::kId, [] {});
  EXPECT_EQ(life.shown(kTag), 7);
  EXPECT_EQ(life.shown(kStray), 5);
}

TEST(SessionMetrics, RoundTripIsThatOfTheLastThousand) {
  MonitoredHands life;
  const std::string p99 = life.of_first_seat("tandem_rtt_seconds", ",quantile=\"0.99\"");
  life.delay = 200ms;
  for (int tick = 0; tick < 2500; ++tick) life.step();
  EXPECT_NEAR(life.read(p99), 0.200, 0.01);
  life.delay = 5ms;
  for (int tick = 0; tick < 2500; ++tick) life.step();
  EXPECT_LT(life.read(p99), 0.010);
  EXPECT_GT(life.hosted.status().seats[0].link.rtt_p99_ms, 150) << "the report has the whole connection";
}

}  // namespace
}  // namespace tandem
