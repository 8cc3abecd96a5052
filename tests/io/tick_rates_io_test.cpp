// One hand presses on bone at several tick rates: live over loopback, in virtual time, and computed by the springs in
// series. Ratios of forces are asserted, and that missed ticks are counted; durations are not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <list>
#include <optional>

#include "tests/io/machine_witness.h"
#include "tests/io/programs.h"
#include "tests/io/traces.h"
#include "tests/support/press_scene.h"

namespace tandem::test {
namespace {

/// Tolerance of the force ratio.
constexpr double kWithin = 0.05;

/// A live session at one tick rate: a server and a client.
struct Live {
  Live(const Folder& folder, double tick_hz, bool replica = false)
      : folder_(folder), name_((replica ? "replica" : "") + std::to_string(static_cast<int>(tick_hz))) {
    press.tick_hz = tick_hz;
    press.replica = replica;
    press.silence_ms = 200;  // so that delays of a busy machine do not count as loss
    host_.emplace(hosting(folder.write(name_ + ".textproto", press.text()),
                          {"--json", file(".server.json"), "--trace", file(".server.csv")}));
    client_.emplace(client(address_of(*host_), "hand", {"--json", file(".json"), "--trace", file(".csv")}));
  }
  void end() {
    ASSERT_EQ(client_->wait(), 0) << client_->err();
    ASSERT_EQ(host_->wait(), 0) << host_->err();
  }
  [[nodiscard]] std::string file(const std::string& ending) const { return folder_.file(name_ + ending); }

  /// Mean motor force on the resting hand [N].
  [[nodiscard]] double force() const {
    const Trace trace{folder_.read(name_ + ".csv")};
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t row = 0; row < trace.size(); ++row) {
      if (!press.rests(trace.at(row, "t_s"))) continue;
      sum -= trace.at(row, "f_out_x");
      ++n;
    }
    EXPECT_GT(n, 10U) << name_ << " Hz: nothing to average";
    return sum / static_cast<double>(std::max<std::size_t>(n, 1));
  }
  /// Tool motion from the server's trace: hand minus tool on the way to the wall [m RMS], and depth of the tool in the
  /// wall at rest [m].
  struct Tool {
    double behind = 0, depth = 0;
  };
  /// Nullopt: a busy server spared so many rows that there is nothing to average.
  [[nodiscard]] std::optional<Tool> tool() const { return tool_of(folder_.read(name_ + ".server.csv"), press); }
  [[nodiscard]] static std::optional<Tool> tool_of(const std::string& server_trace, const PressScene& press) {
    const Trace trace{server_trace};
    double square = 0, depth = 0;
    std::size_t moving = 0, resting = 0;
    for (std::size_t row = 0; row < trace.size(); ++row) {
      const double t = trace.at(row, "t_s"), hand = trace.at(row, "hand.x"), tool = trace.at(row, "tool.x");
      if (t > 0.8 && tool < -1e-3) square += (hand - tool) * (hand - tool), ++moving;
      if (press.rests(t)) depth += tool, ++resting;
    }
    if (moving <= 10 || resting <= 10) return std::nullopt;
    return Tool{std::sqrt(square / static_cast<double>(moving)), depth / static_cast<double>(resting)};
  }
  /// Everything that did not happen in time is counted.
  void expect_missed_ticks_are_counted() const {
    const Json own = folder_.json(name_ + ".json"), report = folder_.json(name_ + ".server.json");
    ASSERT_FALSE(own.is_discarded() || report.is_discarded());
    const double lived = own["machine"]["ticks"].get<double>() + own["machine"]["missed_ticks"].get<double>();
    EXPECT_NEAR(lived / (press.tick_hz * own["seconds"].get<double>()), 1, 0.1)
        << name_ << " Hz, client: " << own["machine"];
    const Trace rows{folder_.read(name_ + ".server.csv")};
    const double ticks = press.duration_s * press.tick_hz;
    double counted = static_cast<double>(rows.size());
    for (const char* count : {"missed_ticks", "recorder_dropped", "recorder_spared"})
      counted += report["machine"][count].get<double>();
    EXPECT_GE(counted, ticks) << name_ << " Hz, server: " << report["machine"];
    EXPECT_LE(static_cast<double>(rows.size()), ticks + 2);
    std::printf("[   live   ] %s Hz: client %.0f ticks, %.0f missed; server %zu rows, %.0f missed\n", name_.c_str(),
                own["machine"]["ticks"].get<double>(), own["machine"]["missed_ticks"].get<double>(), rows.size(),
                report["machine"]["missed_ticks"].get<double>());
  }

  PressScene press;
  MachineWitness witness;

 private:
  const Folder& folder_;
  std::string name_;
  std::optional<Process> host_, client_;
};

/// Force of the same scene in virtual time [N]. @param tool out: motion of the tool, if not null
double virtual_force(const Folder& folder, const PressScene& press, std::optional<Live::Tool>* tool = nullptr) {
  const std::string name = "virtual" + std::to_string(static_cast<int>(press.tick_hz));
  Process run({TANDEM_NETSIM, "run", folder.write(name + ".textproto", press.text()), "--quiet", "--no-quality",
               "--trace", folder.file(name + ".csv")});
  EXPECT_EQ(run.wait(), 0) << run.err();
  const Trace trace{folder.read(name + ".csv")};
  if (tool != nullptr) *tool = Live::tool_of(folder.read(name + ".csv"), press);
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t row = 0; row < trace.size(); ++row)
    if (press.rests(trace.at(row, "t_s"))) sum -= trace.at(row, "hand.f_out_x"), ++n;
  return sum / static_cast<double>(std::max<std::size_t>(n, 1));
}

/// Returns whether the force was judged. It is not if the machine stood still, nor, before the last session, if the
/// force deviates: a datagram that a busy machine delays by one tick at the wall costs law `set_position` a quarter of
/// the force until the hand moves again (seen once in 20 sessions at 100 Hz). A fault of the code shows in every
/// session.
bool expect_one_force(const Folder& folder, const Live& live, bool last) {
  SCOPED_TRACE(live.press.tick_hz);
  const double felt = live.force(), simulated = virtual_force(folder, live.press);
  std::printf("[   live   ] %.0f Hz: %.3f N live, %.3f N in virtual time, %.3f N by the springs\n", live.press.tick_hz,
              felt, simulated, live.press.force());
  if (live.witness.machine_stood_still()) return false;
  if (!last && (std::abs(felt / simulated - 1) > kWithin || std::abs(felt / live.press.force() - 1) > kWithin))
    return false;
  EXPECT_NEAR(felt / simulated, 1, kWithin);
  EXPECT_NEAR(felt / live.press.force(), 1, kWithin);
  return true;
}

/// Law `replica`: the tool presses as hard as the hand feels. On its way it is where it is in virtual time. The
/// tolerance is two more ticks of a busy machine's network at 50 mm/s.
/// Returns whether this was judged. It is not if the machine stood still, or was too busy to write the trace. Tools
/// then meet again only as far as motion gives energy for it: a second later, at rest, the hand may feel 15 % less, and
/// the tool press 12 % harder than that.
bool expect_one_tool(const Folder& folder, const Live& live) {
  SCOPED_TRACE(live.press.tick_hz);
  std::optional<Live::Tool> of_netsim;
  virtual_force(folder, live.press, &of_netsim);
  EXPECT_TRUE(of_netsim);
  const auto of_server = live.tool();
  if (!of_netsim || !of_server) return false;
  const Live::Tool simulated = *of_netsim, tool = *of_server;
  std::printf("[   live   ] %.0f Hz: hand - tool %.3f mm live, %.3f mm in virtual time\n", live.press.tick_hz,
              1e3 * tool.behind, 1e3 * simulated.behind);
  if (live.witness.machine_stood_still()) return false;
  EXPECT_NEAR(tool.depth * PressScene::kWall / live.force(), 1, 0.05);
  EXPECT_NEAR(tool.behind, simulated.behind, 0.5e-3 + 2 * 0.05 / live.press.tick_hz);
  return true;
}

/// Waits for the end of a session and judges it. Returns whether all of it was judged.
bool judge(const Folder& folder, Live& live, bool last) {
  live.end();
  if (testing::Test::HasFatalFailure()) return true;
  bool judged = expect_one_force(folder, live, last);
  if (live.press.replica) judged = expect_one_tool(folder, live) && judged;
  live.expect_missed_ticks_are_counted();
  return judged;
}

/// One session at each rate, at the same time. Returns whether all of them were judged.
bool press_at(std::initializer_list<double> rates, bool replica, bool last) {
  const Folder folder;
  std::list<Live> sessions;
  for (const double tick_hz : rates) sessions.emplace_back(folder, tick_hz, replica);
  bool judged = true;
  for (Live& live : sessions) judged = judge(folder, live, last) && judged;
  return judged;
}

/// Repeats disturbed sessions.
void expect_one_force_at(const char* what, std::initializer_list<double> rates, bool replica = false) {
  int sessions = 0;
  repeat_disturbed(what, [&] { return press_at(rates, replica, ++sessions == kSessionsOfADisturbedMachine); });
}

TEST(TickRatesLive, RenderTheSameForceFrom100To500HzAsInVirtualTime) {
  expect_one_force_at("TickRatesLive, forces at 100 to 500 Hz", {100, 200, 500});
}

TEST(TickRatesLive, RenderTheSameForceAt4kHz) { expect_one_force_at("TickRatesLive, force at 4 kHz", {4000}); }

TEST(TickRatesLive, RenderTheSameForceAt10kHz) { expect_one_force_at("TickRatesLive, force at 10 kHz", {10'000}); }

TEST(TickRatesLive, RenderTheSameForceUnderReplicaFrom100To500HzAsInVirtualTime) {
  expect_one_force_at("TickRatesLive, replica at 100 to 500 Hz", {100, 200, 500}, true);
}

TEST(TickRatesLive, RenderTheSameForceUnderReplicaFrom1To4kHz) {
  for (const double tick_hz : {1000, 2000, 4000})  // sequential: together they need more than two cores
    expect_one_force_at("TickRatesLive, replica from 1 to 4 kHz", {tick_hz}, true);
}

/// A device with its own rate of 1000 exchanges per second: a recorded motion at rest.
std::string device_of_its_own(const Folder& folder) {
  return "replay:" + folder.write("still.csv", "t_s[s],px[m],py[m],pz[m]\n0,-0.01,0,0\n60,-0.01,0,0\n") + ",scale=1";
}

TEST(TickRatesLive, ARealDevicesSeatWorksAtTheScenesRate) {
  const Folder folder;
  PressScene press;
  press.tick_hz = 100;
  press.duration_s = 1.5;
  press.silence_ms = 200;
  Process host = hosting(folder.write("slow.textproto", press.text()), {"--json", folder.file("s.json")});
  Process hand = client(address_of(host), "hand", {"--json", folder.file("c.json")}, device_of_its_own(folder));
  ASSERT_EQ(hand.wait(), 0) << hand.err();
  ASSERT_EQ(host.wait(), 0) << host.err();
  const Json own = folder.json("c.json");
  const double sent = own["link"]["sent"].get<double>(),
               exchanges = own["device_statistics"]["exchanges"].get<double>();
  EXPECT_GT(sent, 100);
  EXPECT_NEAR(sent / exchanges, 0.1, 0.03) << "one STATE per tick of the scene";
}

TEST(TickRatesLive, RejectASceneFasterThanARealDeviceAndNameTheKey) {
  const Folder folder;
  PressScene press;
  press.tick_hz = 4000;
  Process host = hosting(folder.write("fast.textproto", press.text()));
  Process hand = client(address_of(host), "hand", {}, device_of_its_own(folder));
  EXPECT_EQ(hand.wait(), 1);
  for (const char* part : {"tick_hz is 4000", "1000 times a second", "tick_hz 100 to 1000"})
    EXPECT_NE(hand.err().find(part), std::string::npos) << part << " not in " << hand.err();
}

}  // namespace
}  // namespace tandem::test
