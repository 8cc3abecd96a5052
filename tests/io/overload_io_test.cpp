// Overload (ARCHITECTURE.md, invariants 51 and 52) with real programs: a server that the machine runs only
// intermittently. States, counts and order are asserted, never durations.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/io/metrics_page.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// Stops the program repeatedly for `pulse` and lets it run for less than a tick in between. Nearly every tick then
/// begins late by `pulse`.
void slow_down(const Process& program, std::chrono::milliseconds pulse, int pulses) {
  for (int n = 0; n < pulses; ++n) {
    program.signal(SIGSTOP);
    std::this_thread::sleep_for(pulse);
    program.signal(SIGCONT);
    std::this_thread::sleep_for(400us);
  }
}

double gauge(const std::string& page, const std::string& name) {
  const auto at = page.find("\n" + name + "{tick_hz=\"1000\",shard=\"0\"} ");
  return at == std::string::npos ? -1 : std::atof(page.c_str() + page.find(' ', at) + 1);
}

TEST(OverloadLive, ReleasesHandsWhenTicksAreRepeatedlyLateAndRecovers) {
  const Folder folder;
  Process host =
      hosting("one_axis", {"--duration", "3600", "--metrics", "127.0.0.1:0", "--json", folder.file("report.json")});
  std::string metrics = host.after("metrics on http://");
  metrics = metrics.substr(0, metrics.find('/'));
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("trainer.json")});
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();

  const bool promised = (host.out() + host.err()).find("not permitted here: real-time priority") == std::string::npos;
  slow_down(host, promised ? 8ms : 32ms,
            promised ? 400 : 120);  // without real-time priority a quarter of the lateness counts
  ASSERT_TRUE(host.wait_for("OVERLOADED: this machine is too busy")) << host.out() << host.err();
  ASSERT_TRUE(trainer.wait_for("OVERLOADED: the server is too busy")) << trainer.out() << trainer.err();
  ASSERT_TRUE(host.wait_for("the session runs again")) << host.out() << host.err();
  const std::string told = host.out() + host.err();
  EXPECT_NE(told.find("or late, and sheds: telemetry"), std::string::npos) << told;
  const std::string now = page(metrics);
  EXPECT_GE(gauge(now, "tandem_shed_level"), 0) << now;
  EXPECT_GE(gauge(now, "tandem_overloaded"), 0) << now;

  Process status({TANDEM_CLIENT, "control", "--server", address_of(host), "status", "--json"});
  EXPECT_EQ(status.wait(), 0) << status.err();
  const Json stands = Json::parse(status.out(), nullptr, false);
  ASSERT_TRUE(stands.is_object()) << status.out();
  EXPECT_LE(stands["shed"].get<int>(), 6);

  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(folder.json("trainer.json")["verdict"], "pass") << folder.read("trainer.json");
  EXPECT_TRUE(folder.json("report.json")["violations"].empty()) << folder.read("report.json");
}

}  // namespace
}  // namespace tandem::test
