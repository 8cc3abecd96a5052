// User errors with the real programs: exit codes and messages. No program starts before all input was checked.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>

#include "common/io/tcp_listener.h"
#include "common/io/udp_socket.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

void expect_words(const std::string& text, const Words& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "no \"" << word << "\" in\n" << text;
}

void expect_refused(Process process, int code, const Words& words) {
  EXPECT_EQ(process.wait(), code) << process.err();
  expect_words(process.err(), words);
  EXPECT_TRUE(process.out().empty()) << process.out();
}

const std::string kScene =
    "version: 1\n"
    "dof: 1\n"
    "channel { law: SET_POSITION k_n_m: 1000 }\n"
    "device_coupling { k_c_n_m: 400 }\n"
    "seat { name: \"trainer\" kind: MASTER role: INSTRUCTOR required: true device { model: LINEAR } hand { model: "
    "LEADER } }\n"
    "tool { name: \"tool\" slave { model: LINEAR } }\n"
    "authority { tool: \"tool\" seat: \"trainer\" alpha: 1 }\n";

/// The scene with one text replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kScene;
  return text.replace(text.find(from), from.size(), to);
}

TEST(ServerUsageErrors, NameTheirPlacesInAScene) {
  const Folder folder;
  EXPECT_EQ(server({"run", folder.write("good.textproto", kScene), "--check"}).wait(), 0);
  const auto refused = [&](const std::string& text, const Words& words) {
    SCOPED_TRACE(words.back());
    const std::string file = folder.write("s.textproto", text);
    expect_refused(server({"run", file}), 2, words);
    expect_refused(server({"run", file, "--check"}), 2, words);
  };
  refused(changed("dof: 1", "dfo: 1\ndog: 3"), {"s.textproto:2:", "s.textproto:3:", "nothing was started", "dfo"});
  refused("", {"s.textproto", "nothing was started"});
  refused(changed("alpha: 1", "alpha: 0.7"), {"s.textproto:", "sum", "0.7"});
  refused(changed("k_n_m: 1000", "k_n_m: -1000"), {"s.textproto:3:", "k_n_m", "-1000"});
  refused(changed("k_n_m: 1000", "k_n_m: nan"), {"s.textproto:3:", "k_n_m", "nan"});
  refused(changed("k_n_m: 1000", "k_n_m: 1e400"), {"s.textproto:3:", "k_n_m", "1e400"});
  refused(changed("k_c_n_m: 400", "k_c_n_m: 900"), {"s.textproto:4:", "900", "unsafe_gains"});
}

TEST(ServerUsageErrors, AreReportedTogether) {
  const Folder folder;
  expect_refused(
      server({"run", "free_moton", "--listen", "0.0.0.0:7000", "--duration", "soon", "--seed", "-1", "--start-timeout",
              "nan", "--json", folder.file("no/such/folder.json"), "--trace", folder.file("")}),
      2,
      {"did you mean free_motion?", "--listen 0.0.0.0:7000", "tandem-server init", "--duration: \"soon\"",
       "--seed: \"-1\"", "--start-timeout: \"nan\"", "--json: ", "--trace: ", "it is a folder",
       "7 mistakes, nothing was started"});
  expect_refused(server({"run", "free_motion", "--listen", "192.0.2.1:7000"}), 2, {"tandem-server init"});
  expect_refused(server({"run", "free_motion", "--listen", "7000"}), 2, {"needs HOST:PORT"});
  expect_refused(server({"run", "one_axis", "--json", folder.file("a"), "--trace", folder.file("a")}), 2,
                 {"same file"});
}

TEST(ServerUsageErrors, OfTheCommandLineReturnExitCodeTwo) {
  expect_refused(server({"run"}), 2, {"SCENE"});
  expect_refused(server({"run", "free_motion", "--lisen", "127.0.0.1:0"}), 2, {"--lisen"});
  expect_refused(server({"scenes", "--print", "contct"}), 2, {"did you mean contact?"});
  for (const Words& good :
       {Words{"--help"}, Words{"--version"}, Words{"run", "--help"}, Words{"scenes"}, Words{"scenes", "--json"},
        Words{"scenes", "--print", "contact"}, Words{"run", "contact", "--check"}}) {
    Process process = server(good);
    EXPECT_EQ(process.wait(), 0) << good.front();
    EXPECT_FALSE(process.out().empty()) << good.front();
    EXPECT_TRUE(process.err().empty()) << process.err();
  }
}

TEST(ServerErrors, NameAPortInUse) {
  const auto taken = io::bind_udp(*io::parse_address("127.0.0.1:0", 0));
  ASSERT_TRUE(taken);
  const std::string address = io::to_text(taken->local);
  expect_refused(server({"run", "one_axis", "--listen", address}), 1, {address, "in use", "choose another port"});
}

TEST(ClientUsageErrors, AreReportedTogether) {
  const Folder folder;
  const std::string script =
      folder.write("a.csv", "t_s[s],trainer[1],trainee[1]\n0,1,0\n2,0.5,0.6\n1,half,0\n3,2,-1\n");
  expect_refused(client("127.0.0.1", "trainer", {"--alpha-script", script, "--duration", "-1"}, "sim:hand=leadr"), 2,
                 {"needs HOST:PORT", "did you mean leader", "a.csv:3: the authorities sum to 1.1", "a.csv:4: column 2",
                  "half", "a.csv:5: trainer = 2", "--duration: \"-1\"", "nothing was started"});
}

TEST(ClientUsageErrors, NameTheLineInAScript) {
  const Folder folder;
  const auto refused = [&](const std::string& text, const Words& words) {
    SCOPED_TRACE(text);
    expect_refused(client("127.0.0.1:1", "trainer", {"--alpha-script", folder.write("a.csv", text)}), 2, words);
  };
  refused("", {"a.csv"});
  refused("t_s[s]\n0\n", {"a.csv:1", "SEAT[1]"});
  refused("time[s],trainer[1]\n0,1\n", {"a.csv:1", "t_s[s]"});
  refused("t_s[s],trainer[N]\n0,1\n", {"a.csv:1", "trainer[1]"});
  refused("t_s[s],trainer[1]\n0,1\n1\n", {"a.csv:3"});
  refused("t_s[s],trainer[1]\n1,1\n1,1\n", {"a.csv:3", "later"});
  refused("t_s[s],trainer[1]\n0,nan\n", {"a.csv:2"});
  expect_refused(client("127.0.0.1:1", "trainer", {"--alpha-script", folder.file("none.csv")}), 2, {"none.csv"});
}

TEST(ClientUsageErrors, NameTheLineInARecording) {
  const Folder folder;
  const std::string good = "t[s],px[m],py[m],pz[m]\n0,0,0,0\n0.01,0.001,0,0\n";
  const std::string bad = folder.write("nan.csv", good + "0.02,nan,0,0\n");
  expect_refused(client("127.0.0.1:1", "trainer", {}, "sim:motion=" + bad), 2, {"nan.csv", "4"});
  expect_refused(client("127.0.0.1:1", "trainer", {}, "sim:motion=" + folder.file("none.csv")), 2, {"none.csv"});
}

TEST(ClientErrors, ReportAMissingServer) {
  std::string address;
  {
    const auto free = io::bind_udp(*io::parse_address("127.0.0.1:0", 0));
    ASSERT_TRUE(free);
    address = io::to_text(free->local);
  }
  expect_refused(client(address, "trainer", {"--timeout", "0.5"}), 1,
                 {address, "nothing listens there", "tandem-server run"});
  const auto deaf = io::listen_tcp(*io::parse_address("127.0.0.1:0", 0));
  ASSERT_TRUE(deaf);
  expect_refused(client(io::to_text(deaf->local), "trainer", {"--timeout", "0.5"}), 1, {"no answer"});
}

TEST(ClientErrors, ReportARejectionByTheServer) {
  const Folder folder;
  Process host = hosting("free_motion");
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer");
  ASSERT_TRUE(host.wait_for("trainer joined")) << host.err();
  expect_refused(client(address, "trainer"), 1, {"is taken already", "take another seat"});
  expect_refused(client(address, "trainr"), 1, {"no seat of this name", "trainer trainee"});
  expect_refused(client(address, "trainee", {}, "sim:model=linear"), 1, {"does not fit", "3 axes"});
  const std::string script = folder.write("a.csv", "t_s[s],trainer[1],trainee[1]\n0,0,1\n");
  expect_refused(client(address, "trainee", {"--alpha-script", script}), 1, {"only the INSTRUCTOR", "trainee"});
  trainer.signal(SIGINT);
  EXPECT_EQ(trainer.wait(), 1) << "the session never ran: nothing to judge";
  const std::string strange = folder.write("b.csv", "t_s[s],absent[1]\n0,1\n");
  expect_refused(client(address, "trainer", {"--alpha-script", strange}), 2, {"b.csv:1", "absent", "trainer trainee"});
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST(ClientInterruption, BeforeTheServerAnswersIsNoSuccess) {
  const Folder folder;
  for (const Words& command : {Words{"link-test"}, Words{"watch"}, Words{"record", "--out", folder.file("r.mcap")}}) {
    SCOPED_TRACE(command.front());
    const auto silent = io::listen_tcp(*io::parse_address("127.0.0.1:0", 0));
    ASSERT_TRUE(silent) << silent.error();
    Words words{TANDEM_CLIENT};
    words.insert(words.end(), command.begin(), command.end());
    words.insert(words.end(), {"--server", io::to_text(silent->local), "--timeout", "60"});
    Process process(std::move(words));
    pollfd comes{silent->fd.get(), POLLIN, 0};
    ASSERT_EQ(::poll(&comes, 1, 30'000), 1);  // it now waits for the reply
    process.signal(SIGINT);
    EXPECT_EQ(process.wait(), 1);
    expect_words(process.err(), {"ended by Ctrl-C before the server answered"});
    EXPECT_EQ(process.out(), "");
  }
}

}  // namespace
}  // namespace tandem::test
