// Rows of the failure table (tests/FAILURES.md) with real programs on loopback. Outcomes are asserted, never durations.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <thread>

#include "tests/common/base/counts.h"
#include "tests/io/constant_force_scene.h"
#include "tests/io/metrics_page.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// A row of a client's trace.
struct Row {
  double t = 0, x = 0, force = 0,
         gate_force = 0;  ///< session time [s]; tip [m]; delivered and commanded force [N] along x
  int gate = 0;
};

std::vector<Row> trace_of(const Folder& folder, const std::string& name) {
  std::istringstream text(folder.read(name));
  std::string line;
  std::getline(text, line);
  std::vector<std::string> columns;
  for (std::istringstream head(line); std::getline(head, line, ',');) columns.push_back(line);
  const auto column = [&](const char* wanted) {
    return static_cast<std::size_t>(std::ranges::find(columns, wanted) - columns.begin());
  };
  const std::size_t t = column("t_s[s]"), x = column("x[m]"), out = column("f_out_x[N]"),
                    ordered = column("f_gate_x[N]"), gate = column("gate[1]");
  std::vector<Row> rows;
  while (std::getline(text, line)) {
    std::vector<double> v;
    std::string word;
    for (std::istringstream words(line); std::getline(words, word, ',');)
      v.push_back(std::strtod(word.c_str(), nullptr));
    if (v.size() != columns.size()) continue;
    rows.push_back({v[t], v[x], v[out], v[ordered], static_cast<int>(v[gate])});
  }
  return rows;
}

/// Command line that starts `program` with another wall clock: the content of `file` is added to it. Monotonic clocks
/// are not changed.
Words faked(const std::string& library, const std::string& file, Words program) {
  Words command{"/usr/bin/env",
                "LD_PRELOAD=" TANDEM_REAL_SLEEP ":" + library,
                "FAKETIME_TIMESTAMP_FILE=" + file,
                "FAKETIME_NO_CACHE=1",
                "FAKETIME_DONT_FAKE_MONOTONIC=1",
                "FAKETIME_DISABLE_SHM=1"};
  command.insert(command.end(), program.begin(), program.end());
  return command;
}

// Wall-clock jump: force change <= 0.01 N for +-1 h, +-10 y, monotonic clocks not faked.
TEST(FailureLive, ChangesNoForceWhenWallClocksJump) {
  const std::string library = "/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1";
  if (!fs::exists(library)) GTEST_SKIP() << "libfaketime is not installed (apt install faketime; ./test --full does)";
#ifdef TANDEM_SANITIZED
  GTEST_SKIP() << "a sanitizer's library must be the first that is loaded";
#endif
  const Folder folder;
  const std::string scene = folder.write("press.textproto", constant_force_scene()),
                    clock = folder.write("clock", "+0\n");
  Process host(faked(library, clock, {TANDEM_SERVER, "run", scene, "--log", "json", "--json", folder.file("s.json")}));
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  const auto join = [&](const std::string& seat) {
    return Process(faked(library, clock,
                         {TANDEM_CLIENT, "join", "--server", address_of(host), "--seat", seat, "--device", "sim",
                          "--trace", folder.file(seat + ".csv"), "--json", folder.file(seat + ".json")}));
  };
  Process trainer = join("trainer"), trainee = join("trainee");
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  std::this_thread::sleep_for(10s);  // both hands press and rest by now
  for (const char* jump : {"+3600", "+0", "-3600", "+0", "+10y", "+0", "-10y"}) {
    folder.write("clock", std::string(jump) + "\n");
    std::this_thread::sleep_for(800ms);
  }
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  // Proves that the clock was changed: the server's last log line is ten years from its first.
  const auto year = [&](std::size_t at) { return std::atoi(host.err().c_str() + at + 6); };
  const std::size_t first = host.err().find("\"ts\":\""), last = host.err().rfind("\"ts\":\"");
  ASSERT_NE(first, std::string::npos) << host.err();
  EXPECT_EQ(year(first) - year(last), 10) << host.err();
  for (const char* seat : {"trainer", "trainee"}) {
    SCOPED_TRACE(seat);
    double least = 1e9, most = -1e9;
    const std::vector<Row> rows = trace_of(folder, std::string(seat) + ".csv");
    ASSERT_GT(rows.size(), 1000U);
    std::size_t late = folder.json("s.json")["machine"]["late_ticks"].get<std::size_t>();
    double before = 9;
    for (const Row& r : rows) {
      if (r.t < 9 || r.gate != 3) continue;
      late += r.t - before > 0.004 ? 1 : 0;
      before = r.t;
      least = std::min(
          least, r.gate_force);  // the commanded force: a late exchange lets a command expire, whatever the clocks do
      most = std::max(most, r.gate_force);
    }
    std::printf("[ failure  ] %s: %.4f to %.4f N while wall clocks jump by +-1 h and +-10 y\n", seat, least, most);
    EXPECT_GT(std::abs(least), 0.5) << "no hand was pressed";
    if (late > 0) {
      std::printf(
          "[ NOT RUN ] FailureLive.ChangesNoForceWhenWallClocksJump, force of the %s: threads of this machine woke up "
          "late %zu times\n",
          seat, late);
    } else {
      EXPECT_LE(most - least, 0.01);
    }
  }
  EXPECT_EQ(folder.json("s.json")["violations"], Json::array());
}

// Client paused 500 ms: it releases first, no datagram of the backlog acts, the other clients continue.
TEST(FailureLive, ReleasesAPausedClientFirstAndAppliesNoBacklog) {
  const Folder folder;
  Process host = hosting(folder.write("press.textproto", constant_force_scene(100)), {"--json", folder.file("s.json")});
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("trainer.json")});
  Process trainee = client(address_of(host), "trainee",
                           {"--trace", folder.file("trainee.csv"), "--json", folder.file("trainee.json")});
  ASSERT_TRUE(trainee.wait_for("the session runs")) << trainee.err();
  const std::size_t pauses = draws(2, 10, 100);
  for (std::size_t n = 0; n < pauses; ++n) {
    std::this_thread::sleep_for(3500ms);
    trainee.signal(SIGSTOP);
    std::this_thread::sleep_for(500ms);
    trainee.signal(SIGCONT);
  }
  std::this_thread::sleep_for(2s);
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  const std::vector<Row> rows = trace_of(folder, "trainee.csv");
  std::size_t seen = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].t - rows[i - 1].t < 0.4) continue;
    ++seen;
    EXPECT_EQ(rows[i - 1].gate, 3) << "the hand was engaged when its program was stopped";
    EXPECT_EQ(rows[i].gate, 4) << "PASSIVE before anything else, at " << rows[i].t;
    EXPECT_EQ(rows[i].gate_force, 0) << "the device has forgotten the force: no ramp begins from it";
    std::size_t again = i;
    for (; again < rows.size() && rows[again].gate != 2;
         ++again) {  // the remaining force may brake the hand and never push it
      const double speed = again == i ? 0 : (rows[again].x - rows[again - 1].x) / (rows[again].t - rows[again - 1].t);
      EXPECT_LE(rows[again].gate_force * speed > 0 ? std::abs(rows[again].gate_force) : 0, 0.05) << rows[again].t;
    }
    ASSERT_LT(again, rows.size()) << "never engaged again";
    EXPECT_LE(std::abs(rows[again].gate_force), 0.05) << "starts again at zero";
  }
  EXPECT_EQ(seen, pauses);
  EXPECT_GE(folder.json("trainee.json")["gate"]["trips"].get<std::size_t>(), pauses);
  EXPECT_EQ(folder.json("s.json")["violations"], Json::array());
}

/// Waits until a gauge of one seat becomes `value`.
bool becomes(const std::string& metrics, const std::string& gauge, const std::string& seat, double value) {
  for (int i = 0; i < 300; ++i) {
    const std::string all = page(metrics);
    for (std::size_t at = all.find("\n" + gauge + "{"); at != std::string::npos;
         at = all.find("\n" + gauge + "{", at + 1)) {
      const std::string line = all.substr(at + 1, all.find('\n', at + 1) - at - 1);
      if (line.find("seat=\"" + seat + "\"") != std::string::npos &&
          std::abs(std::strtod(line.c_str() + line.rfind(' '), nullptr) - value) < 1e-3)
        return true;
    }
    std::this_thread::sleep_for(100ms);
  }
  return false;
}

// Client kill -9: its authority goes to the other seats, the session continues, and the client comes back.
TEST(FailureLive, TransfersTheAuthorityOfAKilledClientAndLetsItComeBack) {
  const Folder folder;
  Process host = hosting(folder.write("press.textproto", constant_force_scene(300, false)),
                         {"--metrics", "127.0.0.1:0", "--json", folder.file("s.json")});
  std::string metrics = host.after("metrics on http://");
  metrics = metrics.substr(0, metrics.find('/'));
  ASSERT_FALSE(metrics.empty()) << host.out();
  Process trainer = client(address_of(host), "trainer",
                           {"--json", folder.file("trainer.json"), "--trace", folder.file("trainer.csv")});
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  const std::size_t kills = draws(3, 20, 100);
  for (std::size_t n = 0; n < kills; ++n) {
    SCOPED_TRACE(n);
    Process trainee = client(address_of(host), "trainee", {"--timeout", "30"});
    while (!becomes(metrics, "tandem_authority", "trainee", 0.5)) {  // otherwise its seat was not free yet
      ASSERT_EQ(trainee.wait(), 1) << trainee.err();
      trainee = client(address_of(host), "trainee", {"--timeout", "30"});
    }
    ASSERT_TRUE(becomes(metrics, "tandem_gate_state", "trainee", 3));
    trainee.signal(SIGKILL);
    EXPECT_EQ(trainee.wait(), -SIGKILL);
    EXPECT_TRUE(becomes(metrics, "tandem_authority", "trainee", 0));
    EXPECT_TRUE(becomes(metrics, "tandem_authority", "trainer", 1));
    std::this_thread::sleep_for(2100ms);  // after that any client may take the seat
  }
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(folder.json("s.json")["violations"], Json::array());
  // Virtual time asserts that a kill trips no other gate. Here a thread that this machine wakes up late may trip it.
  std::printf("[ failure  ] trips of the other hand's gate: %s\n",
              folder.json("trainer.json")["gate"]["trips"].dump().c_str());
  double step = 0;
  const std::vector<Row> rows = trace_of(folder, "trainer.csv");
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].t > 5) step = std::max(step, std::abs(rows[i].force - rows[i - 1].force));
  std::printf("[ failure  ] %zu kills: the other hand's force changed by at most %.3f N within a tick of 2 ms\n", kills,
              step);
}

}  // namespace
}  // namespace tandem::test
