// `tandem-client watch` with real programs: its output, its ends, and the number of watchers.
#include <gtest/gtest.h>
#include <signal.h>

#include <list>
#include <sstream>

#include "tests/io/programs.h"

namespace tandem::test {
namespace {

Process watch(const std::string& address, Words arguments = {}) {
  Words command{TANDEM_CLIENT, "watch", "--server", address};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return Process(std::move(command));
}

/// The same with its output in a file, because a full pipe would stop the program.
Process watch_into(const std::string& file, const std::string& address, const std::string& role) {
  return Process({"/bin/sh", "-c", "exec \"$0\" watch --server \"$1\" --json --role \"$2\" > \"$3\"", TANDEM_CLIENT,
                  address, role, file});
}

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (Json j = Json::parse(line, nullptr, false); !j.is_discarded()) out.push_back(std::move(j));
  return out;
}

TEST(WatchLive, ShowsARunningSessionAndEndsWithIt) {
  Process host = hosting("one_axis", {"--duration", "4"});
  Process trainer = client(address_of(host), "trainer");
  const Folder folder;
  Process seen = watch_into(folder.file("seen"), address_of(host), "operator"), text = watch(address_of(host));
  EXPECT_EQ(seen.wait(), 0) << seen.err();
  EXPECT_EQ(text.wait(), 0) << text.err();
  EXPECT_NE(seen.err().find("the session is over"), std::string::npos) << seen.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const std::vector<Json> states = lines_of(folder.read("seen"));
  ASSERT_GT(states.size(), 60u);
  bool engaged = false, moved = false, linked = false;
  std::uint64_t tick = 0;
  for (const Json& j : states) {
    EXPECT_GE(j["tick"].get<std::uint64_t>(), tick) << "never backwards";
    tick = j["tick"].get<std::uint64_t>();
    const Json& seat = j["seats"][0];
    EXPECT_EQ(seat["name"], "trainer");
    engaged = engaged || seat["engaged"].get<bool>();
    linked = linked || seat["rtt_ms"].is_number();
    moved = moved || (j["tools"][0]["x_m"].is_array() && std::abs(j["tools"][0]["x_m"][0].get<double>()) > 1e-3);
  }
  EXPECT_TRUE(engaged && moved && linked);
  EXPECT_NE(text.out().find("s running | trainer active 100 %"), std::string::npos) << text.out();
}

TEST(WatchLive, GivesARecorderMoreThanAConsole) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "3"});
  Process trainer = client(address_of(host), "trainer");
  Process console = watch_into(folder.file("console"), address_of(host), "operator"),
          recorder = watch_into(folder.file("recorder"), address_of(host), "recorder");
  EXPECT_EQ(console.wait(), 0) << console.err();
  EXPECT_EQ(recorder.wait(), 0) << recorder.err();
  const auto seen = lines_of(folder.read("console")).size(), recorded = lines_of(folder.read("recorder")).size();
  ASSERT_GT(seen, 60u);
  EXPECT_GT(static_cast<double>(recorded) / static_cast<double>(seen), 5) << "every tick against every 17th";
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(WatchLive, EndsCleanlyOnCtrlCAndFreesItsPlace) {
  const Process host = hosting("one_axis");
  std::list<Process> all;
  for (int n = 0; n < 8; ++n) {
    all.push_back(watch(address_of(host)));
    ASSERT_TRUE(all.back().wait_for("s waiting")) << all.back().err();
  }
  Process ninth = watch(address_of(host));
  EXPECT_EQ(ninth.wait(), 1);
  EXPECT_NE(ninth.err().find("all 8 places of watching consoles of this session are taken"), std::string::npos)
      << ninth.err();
  all.front().signal(SIGINT);
  EXPECT_EQ(all.front().wait(), 0) << all.front().err();
  Process next = watch(address_of(host));
  EXPECT_TRUE(next.wait_for("s waiting")) << next.err();
}

TEST(WatchLive, SaysThatTheServerWasLost) {
  Process host = hosting("one_axis");
  Process seen = watch(address_of(host));
  ASSERT_TRUE(seen.wait_for("s waiting")) << seen.err();
  host.signal(SIGKILL);
  EXPECT_EQ(seen.wait(), 1);
  EXPECT_NE(seen.err().find("tandem-client watch: the server"), std::string::npos) << seen.err();
}

TEST(WatchLive, ReportsWrongArgumentsAndMissingServers) {
  Process wrong = watch("127.0.0.1:9", {"--role", "trainee", "--timeout", "-1"});
  EXPECT_EQ(wrong.wait(), 2);
  for (const char* part : {"--role", "operator, instructor, evaluator or recorder", "--timeout"})
    EXPECT_NE(wrong.err().find(part), std::string::npos) << part << " not in " << wrong.err();
  Process none = watch("127.0.0.1:9", {"--timeout", "0.3"});
  EXPECT_EQ(none.wait(), 1);
  EXPECT_NE(none.err().find("no server at 127.0.0.1:9"), std::string::npos) << none.err();
}

}  // namespace
}  // namespace tandem::test
