// `tandem-client watch` with real programs: its output, its ends, and the number of watchers.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>

#include <algorithm>
#include <list>
#include <sstream>

#include "common/io/udp_socket.h"
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

TEST(WatchLive, StreamsToPlotJugglerAtMost100TimesPerSecond) {
  const io::UdpSocket plot = io::bind_udp(io::parse_address("127.0.0.1:0", 0).value()).value();
  Process host = hosting("one_axis", {"--duration", "3"});
  Process trainer = client(address_of(host), "trainer");
  const Folder folder;
  Process seen({"/bin/sh", "-c", "exec \"$0\" watch --server \"$1\" --role recorder --plotjuggler \"$2\" > \"$3\"",
                TANDEM_CLIENT, address_of(host), io::to_text(plot.local), folder.file("seen")});
  // Reads while the session runs, so that the socket's buffer never fills.
  std::vector<Json> samples;
  std::vector<char> bytes(65536);
  while (true) {
    pollfd ready{plot.fd.get(), POLLIN, 0};
    if (poll(&ready, 1, 3000) != 1) break;  // nothing for 3 s: the session is over
    const ssize_t size = recv(plot.fd.get(), bytes.data(), bytes.size(), 0);
    ASSERT_GT(size, 0);
    samples.push_back(Json::parse(bytes.data(), bytes.data() + size));
  }
  EXPECT_EQ(seen.wait(), 0) << seen.err();
  EXPECT_NE(seen.err().find("JSON over UDP to " + io::to_text(plot.local)), std::string::npos) << seen.err();
  EXPECT_EQ(seen.err().find("readable for everyone"), std::string::npos) << "this computer";
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  ASSERT_GT(samples.size(), 100u);
  const Json& last = samples.back();
  EXPECT_TRUE(last["seats"]["trainer"]["measured_cp"]["x"].is_number()) << last;
  EXPECT_TRUE(last["seats"]["trainer"]["measured_cf"]["norm"].is_number()) << last;
  EXPECT_TRUE(last["seats"]["trainer"]["rtt_ms"].is_number()) << last;
  EXPECT_TRUE(
      std::ranges::any_of(samples, [](const Json& j) { return j["tools"]["tool"]["alpha"]["trainer"] == 1.0; }));
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double step = samples[k]["timestamp"].get<double>() - samples[k - 1]["timestamp"].get<double>();
    EXPECT_GE(step, 0.01 - 1e-6) << "at most 100 per second";
  }
  EXPECT_GT(last["session"]["t"].get<double>(), 1);
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
  EXPECT_NE(seen.err().find("tandem-client watch: the server ended this connection: it has ended, was killed or is "
                            "being restarted. Start again when it is back; a ticket is valid once\n"),
            std::string::npos)
      << seen.err();
}

/// Its connection stays open, so that only the silence shows it.
TEST(WatchLive, SaysThatAServerThatStandsStillWasLost) {
  Process host = hosting("one_axis");
  Process seen = watch(address_of(host));
  ASSERT_TRUE(seen.wait_for("s waiting")) << seen.err();
  host.signal(SIGSTOP);
  EXPECT_EQ(seen.wait(), 1);
  EXPECT_NE(seen.err().find("tandem-client watch: the server was lost: no datagram for 3 s. Start again"),
            std::string::npos)
      << seen.err();
  host.signal(SIGCONT);
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
