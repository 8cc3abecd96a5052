// Values that watchers get of seats with a motion scale; and that a watcher does not change which ticks make a record.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "client/diagnostics/session_watch.h"
#include "netsim/system/simulated_handshake.h"
#include "server/session/session_telemetry.h"
#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

void endless_session(SceneSpec& scene) { scene.duration = 3600; }
void stops_the_clock(SceneSpec& scene) {
  endless_session(scene);
  scene.clock_runs_while_stopped = false;
}
void small_motion(SceneSpec& scene) {
  endless_session(scene);
  for (std::size_t i = 0; i < scene.masters(); ++i) scene.seats[i].motion_scale = 0.5;
}

/// TELEMETRY of this tick, as a watcher decodes it.
wire::SessionTelemetry as_decoded(const SessionFixture& s) {
  const wire::TelemetryCodec codec(telemetry_layout(s.scene));
  wire::SessionTelemetry out;
  fill_telemetry(*s.session, s.now, 0, out);
  std::array<std::byte, wire::kPlaintextMax> bytes;
  const std::size_t size = codec.encode({}, out, bytes);
  const auto decoded = codec.decode_telemetry(std::span{bytes}.first(size));
  EXPECT_TRUE(decoded);
  return decoded ? decoded->message : out;
}

TEST(WatchedValues, TheForceIsThatOnTheHandAtAnyMotionScale) {
  SessionFixture s("lesson", 3, {}, 0, small_motion);
  bool pushed = false;
  for (int n = 0; n < 4000; ++n) {
    s.run(1ms);
    if (n % 50 != 0) continue;
    const wire::SessionTelemetry seen = as_decoded(s);
    for (std::size_t i = 0; i < s.scene.masters(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double on_hand = s.session->seat(i).telemetry().f_out[k];
        ASSERT_EQ(seen.seats[i].f[k], on_hand) << n;
        pushed |= std::abs(on_hand) > 0.01;
      }
  }
  EXPECT_TRUE(pushed) << "else every scale gives 0";
}

/// Ticks of a session with a record interval of 10 that made a record, around a stop.
std::vector<int> recorded_ticks(bool watched) {
  SessionFixture s("free_motion", 3, {}, 0, stops_the_clock);
  std::unique_ptr<client::SessionWatch> watch;
  if (watched) {
    const auto joined = netsim::simulate_watch_join(*s.session, s.now, RandomKey{77}, 1, true);
    EXPECT_TRUE(joined);
    watch = std::make_unique<client::SessionWatch>(telemetry_layout(s.scene), s.session->seat_catalogue().tick(),
                                                   joined->channel_params);
  }
  s.session->set_record_interval(10);
  std::vector<int> out;
  std::array<std::byte, transport::kDatagramMax> buffer;
  for (int n = 0; n < 3000; ++n) {
    if (n == 2003) {
      EXPECT_TRUE(s.session->stop_control().request(s.now, {AccessRole::kInstructor}));
    }
    s.tick([&] {
      while (watch != nullptr) {
        const auto size = watch->poll_transmit(s.now, buffer);
        if (!size) break;
        s.session->on_datagram(s.now, address(200), std::span{buffer}.first(*size));
      }
    });
    for (const auto& [to, bytes] : s.others)
      if (watch != nullptr && to == 200) static_cast<void>(watch->on_datagram(s.now, bytes));
    if (s.session->recorded()) out.push_back(n);
  }
  EXPECT_EQ(watched, watch != nullptr && watch->newest().has_value());
  return out;
}

TEST(WatchedValues, AWatcherDoesNotChangeWhichTicksMakeARecord) {
  const std::vector<int> alone = recorded_ticks(false);
  EXPECT_LT(alone.size(), 2900u);
  EXPECT_EQ(alone, recorded_ticks(true));
}

}  // namespace
}  // namespace tandem::server
