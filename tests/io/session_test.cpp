// A whole session: real programs, real sockets on loopback. Outcomes are asserted, never durations.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>

#include <cmath>
#include <cstdlib>

#include "common/base/rng.h"
#include "common/io/udp_socket.h"
#include "common/transport/digest.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

std::size_t lines(const std::string& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

void expect_good_report(const Json& report, const std::string& scene, std::size_t seats) {
  ASSERT_FALSE(report.is_discarded());
  EXPECT_EQ(report["scenario"], scene);
  EXPECT_EQ(report["verdict"], "pass") << report["violations"];
  EXPECT_EQ(report["ended_by"], "scene");
  EXPECT_EQ(report["machine"]["recorder_dropped"], 0);
  EXPECT_GE(report["machine"]["late_ticks"], 0);
  EXPECT_GE(report["machine"]["missed_ticks"], 0);
  EXPECT_TRUE(report["machine"]["realtime"].is_boolean());
  EXPECT_NEAR(report["duration_s"].get<double>(), 3.0, 0.5);
  ASSERT_EQ(report["seats"].size(), seats);
  for (const Json& seat : report["seats"]) {
    SCOPED_TRACE(seat["name"]);
    ASSERT_TRUE(seat["tracking_rms_m"].is_number());  // NaN would become null
    EXPECT_LT(seat["tracking_rms_m"].get<double>(), 0.05);
    EXPECT_GT(seat["speed_peak_m_s"].get<double>(), 0.01) << "no hand moved";
    EXPECT_GT(seat["link"]["rtt_p50_ms"].get<double>(), 0);
    EXPECT_GT(seat["energy"]["in_j"].get<double>() + seat["energy"]["out_j"].get<double>(), 0);
  }
}

TEST(LiveSession, OfOneAxisRunsToItsEnd) {
  const Folder folder;
  Process host =
      hosting("one_axis", {"--duration", "3", "--json", folder.file("s.json"), "--trace", folder.file("s.csv")});
  Process trainer =
      client(address_of(host), "trainer", {"--json", folder.file("c.json"), "--trace", folder.file("c.csv")});
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  expect_good_report(folder.json("s.json"), "one_axis", 1);
  const Json own = folder.json("c.json");
  EXPECT_EQ(own["ended_by"], "done");
  EXPECT_EQ(own["seat"], "trainer");
  EXPECT_GT(own["link"]["accepted"].get<double>(), 100);
  EXPECT_EQ(own["link"]["refused"], 0);
  EXPECT_EQ(folder.read("c.csv").substr(0, 24), "t_s[s],q0[m],x[m],y[m],z");
  EXPECT_GT(lines(folder.read("c.csv")), 100u);
}

TEST(LiveSession, FullDiskNamesEachFileThatItCuts) {
  const Folder folder;
  // A limit of the file size in place of a full disk: it cuts each file of this process, and no other.
  Process host({"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 8; exec \"$@\"", "sh", TANDEM_SERVER, "run", "free_motion",
                "--duration", "1", "--json", folder.file("s.json"), "--trace", folder.file("s.csv")});
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  Process trainer = client(address_of(host), "trainer");
  Process trainee = client(address_of(host), "trainee");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 1);
  for (const char* name : {"s.json", "s.csv"})
    EXPECT_NE(host.err().find(folder.file(name)), std::string::npos) << name << "\n" << host.err();
}

TEST(LiveSession, OfTwoHandsIsTracedAndHashedToTheLastByte) {
  const Folder folder;
  Process host =
      hosting("free_motion", {"--duration", "3", "--json", "-", "--trace", folder.file("s.csv"), "--seed", "7"});
  // With the report on standard output, messages go to standard error.
  EXPECT_TRUE(host.out().empty()) << host.out();
  const auto at = host.err().find("listening on ");
  ASSERT_NE(at, std::string::npos);
  const std::string address = host.err().substr(at + 13, host.err().find('\n', at) - at - 13);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const Json report = Json::parse(host.out(), nullptr, false);
  expect_good_report(report, "free_motion", 2);
  EXPECT_EQ(report["seed"], 7);
  const std::string trace = folder.read("s.csv");
  transport::Digest digest;
  digest.add(trace);
  EXPECT_EQ(report["trace_hash"], digest.hex());
  EXPECT_EQ(trace.substr(0, 13), "tick[1],t_s[s");
  // Every tick of the session is a row, except missed ticks that the server ran at once because the machine was busy.
  EXPECT_GE(lines(trace) + report["machine"]["missed_ticks"].get<std::size_t>(), 3000u);
  EXPECT_LE(lines(trace), 3002u);
}

TEST(LiveSession, IsNotAffectedByRandomBytes) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "3", "--json", folder.file("s.json")});
  const auto port = io::parse_address(address_of(host), 1);
  ASSERT_TRUE(port);
  Process trainer = client(address_of(host), "trainer");
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  auto noise = io::connect_udp(*port);
  ASSERT_TRUE(noise);
  const RandomKey random{1};
  std::uint64_t draws = 0;
  std::array<std::byte, 1400> bytes;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t size = random.bits(draws++) % bytes.size();
    for (std::size_t k = 0; k < size; ++k) bytes[k] = static_cast<std::byte>(random.bits(draws++));
    // Most are dropped at the first byte. These look like Tandem's datagrams, for no connection and for the first
    // seats.
    if (i % 2 == 0 && size > 24) bytes[0] = static_cast<std::byte>(0x50 | (i % 16));
    ::send(noise->fd.get(), bytes.data(), size, 0);
  }
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_LT(::recv(noise->fd.get(), bytes.data(), bytes.size(), MSG_DONTWAIT), 0) << "random bytes were answered";
  expect_good_report(folder.json("s.json"), "one_axis", 1);
}

TEST(LiveSession, LetsTheInstructorsScriptMoveAuthority) {
  const Folder folder;
  const std::string script = folder.write("a.csv", "t_s[s],trainer[1],trainee[1]\n0,1,0\n0.3,0.25,0.75\n");
  // A transfer that is refused, because a datagram of a hand is late, is requested again: that needs the longer
  // session.
  Process host = hosting("free_motion", {"--duration", "4", "--json", folder.file("s.json")});
  Process trainer = client(address_of(host), "trainer", {"--alpha-script", script});
  Process trainee = client(address_of(host), "trainee", {"--json", folder.file("c.json")});
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const Json seats = folder.json("s.json")["seats"];
  EXPECT_NEAR(seats[0]["alpha_mean"].get<double>() + seats[1]["alpha_mean"].get<double>(), 1, 1e-9);
  EXPECT_GT(seats[1]["alpha_mean"].get<double>(), 0.2);
}

TEST(LiveSession, GoesOnWhenATraineeIsKilled) {
  Process host = hosting("free_motion");
  Process trainer = client(address_of(host), "trainer"), trainee = client(address_of(host), "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  trainee.signal(SIGKILL);
  EXPECT_EQ(trainee.wait(), -SIGKILL);
  // The trainee had no authority: the trainer continues alone, and another client may take the seat.
  Process again = client(address_of(host), "trainee", {"--timeout", "20", "--duration", "0.5"});
  while (again.wait() == 1) {  // "seat taken" until the server knows that the owner is gone
    ASSERT_NE(again.err().find("is taken already"), std::string::npos) << again.err();
    again = client(address_of(host), "trainee", {"--timeout", "20", "--duration", "0.5"});
  }
  EXPECT_EQ(again.wait(), 0) << again.err();
  EXPECT_EQ(host.err().find("BRAKED"), std::string::npos) << host.err();
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_NE(trainer.err().find("the server ended the session"), std::string::npos) << trainer.err();
}

TEST(LiveSession, BrakesTheToolWhenTheAuthorityHolderIsKilled) {
  const Folder folder;
  Process host = hosting("eight_seats", {"--json", folder.file("s.json")});
  Process trainee = client(address_of(host), "trainee"), evaluator = client(address_of(host), "evaluator3");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  trainee.signal(SIGKILL);
  EXPECT_TRUE(host.wait_for("BRAKED")) << host.err();
  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_NE(host.err().find("ended by SIGTERM: all hands are released"), std::string::npos) << host.err();
  EXPECT_EQ(evaluator.wait(), 0) << evaluator.err();
  const Json report = folder.json("s.json");
  EXPECT_EQ(report["ended_by"], "signal");
  EXPECT_NE(report["verdict"], "fail")
      << report["violations"];  // a slow machine kills before there is anything to judge
  EXPECT_EQ(report["violations"].size(), 0U) << report["violations"];
}

TEST(LiveSession, ReportsTheDevicesPeriodsAsAHistogram) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "2"});
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("c.json")});
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  const Json j = folder.json("c.json");
  EXPECT_EQ(j["verdict"], "pass");
  const Json& device = j["device_statistics"];
  for (const char* count : {"exchanges", "late", "missed_periods", "unanswered", "resyncs"})
    EXPECT_TRUE(device[count].is_number_unsigned()) << count;
  std::uint64_t held = 0;
  double before = 0;
  for (const Json& bucket : device["period_ms"]["buckets"]) {
    EXPECT_GE(bucket["from"].get<double>(), before - 1e-9);
    before = bucket["to"].get<double>();
    EXPECT_GT(before, bucket["from"].get<double>());
    held += bucket["count"].get<std::uint64_t>();
  }
  EXPECT_EQ(held, device["period_ms"]["count"].get<std::uint64_t>());
  EXPECT_EQ(held, device["exchanges"].get<std::uint64_t>());
  EXPECT_TRUE(device["round_trip_ms"].is_null()) << "a simulated device exchanges nothing";
  EXPECT_NE(trainer.err().find("device: "), std::string::npos) << trainer.err();
  EXPECT_NE(trainer.err().find("period: p50 "), std::string::npos) << trainer.err();
}

TEST(LiveSession, IsNotJudgedWhenItNeverRan) {
  const Folder folder;
  Process host = hosting("free_motion");
  Process trainer = client(address_of(host), "trainer", {"--duration", "0.5", "--json", folder.file("c.json")});
  EXPECT_EQ(trainer.wait(), 1) << trainer.err();
  EXPECT_EQ(folder.json("c.json")["verdict"], "not_judged");
  EXPECT_EQ(folder.json("c.json")["ended_by"], "left");
  EXPECT_NE(trainer.err().find("the session never ran"), std::string::npos) << trainer.err();
  Process nobody = client("127.0.0.1:9", "trainer", {"--timeout", "0.2", "--json", folder.file("n.json")});
  EXPECT_EQ(nobody.wait(), 1);
  EXPECT_EQ(folder.json("n.json")["verdict"], "not_judged");
  EXPECT_EQ(folder.json("n.json")["ended_by"], "never_attached");
  EXPECT_NE(folder.json("n.json")["reason"].get<std::string>().find("no server at"), std::string::npos);
  const std::string motion = folder.write("m.csv", "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n1,0.01,0,0\n");
  Process ended =
      client("127.0.0.1:9", "trainer", {"--timeout", "60", "--json", folder.file("e.json")}, "replay:" + motion);
  ASSERT_TRUE(ended.wait_for("ready")) << ended.err();  // the device; now the client sends its join request
  ended.signal(SIGTERM);
  EXPECT_EQ(ended.wait(), 1);
  EXPECT_NE(ended.err().find("ended by SIGTERM"), std::string::npos) << ended.err();
  EXPECT_EQ(folder.json("e.json")["verdict"], "not_judged");
}

TEST(LiveSession, EndsGentlyOnCtrlCOfTheClient) {
  const Folder folder;
  Process host = hosting("one_axis");
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("c.json")});
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  trainer.signal(SIGINT);
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_TRUE(host.wait_for("trainer left")) << host.err();
  EXPECT_EQ(folder.json("c.json")["ended_by"], "left");
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(LiveSession, ReconnectsAClientWhoseDatagramsDoNotArrive) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "120"});
  Process proxy(Words{TANDEM_NETSIM, "proxy", "--to", address_of(host), "--control", folder.file("p.sock")});
  ASSERT_TRUE(proxy.wait_for("listening on ")) << proxy.err();
  Process trainer = client(address_of(proxy), "trainer");
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  Process cut(Words{TANDEM_NETSIM, "control", folder.file("p.sock"), "loss", "100", "up"});
  ASSERT_EQ(cut.wait(), 0) << cut.err();
  EXPECT_TRUE(trainer.wait_for("the server fell silent"))
      << trainer.err() << "once a second it reports that it receives nothing";
  Process mended(Words{TANDEM_NETSIM, "control", folder.file("p.sock"), "loss", "0", "up"});
  ASSERT_EQ(mended.wait(), 0) << mended.err();
  EXPECT_TRUE(trainer.wait_for("the server is back")) << trainer.err();
  trainer.signal(SIGINT);
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(LiveSession, WaitsForRequiredSeatsUntilTheStartTimeout) {
  Process host = hosting("free_motion", {"--start-timeout", "1"});
  Process trainer = client(address_of(host), "trainer");
  EXPECT_EQ(host.wait(), 1);
  EXPECT_NE(host.err().find("trainee (not joined)"), std::string::npos) << host.err();
  EXPECT_EQ(trainer.wait(), 1) << "nothing ran, nothing is judged";
}

}  // namespace
}  // namespace tandem::test
