// Program tandem-netsim from the side of users and scripts: exit codes, the line they parse, JSON.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/netsim/proxy/app/udp_peer.h"

extern char** environ;

namespace tandem::netsim {
namespace {

using namespace test;

/// One run of tandem-netsim; standard output and standard error have one pipe each.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TANDEM_NETSIM_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    int out[2], err[2];
    EXPECT_EQ(pipe2(out, O_CLOEXEC), 0);
    EXPECT_EQ(pipe2(err, O_CLOEXEC), 0);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
    EXPECT_EQ(posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    out_ = io::Fd{out[0]};
    err_ = io::Fd{err[0]};
    ::close(out[1]);
    ::close(err[1]);
  }
  ~Program() {
    if (pid_ > 0) {
      kill(SIGKILL);
      exit_code();
    }
  }

  std::string line() {
    std::string text;
    char c = 0;
    while (::read(out_.get(), &c, 1) == 1 && c != '\n') text += c;
    return text;
  }
  std::string rest_of_out() { return all_of(out_); }
  std::string rest_of_err() { return all_of(err_); }
  void kill(int signal) { ::kill(pid_, signal); }
  int exit_code() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  static std::string all_of(const io::Fd& fd) {
    std::string text;
    char buffer[4096];
    for (ssize_t n = 0; (n = ::read(fd.get(), buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(n));
    return text;
  }
  pid_t pid_ = 0;
  io::Fd out_, err_;
};

TEST(Program, ForwardsAsProxyAndEndsCleanlyOnBothSignals) {
  for (const int signal : {SIGINT, SIGTERM}) {
    UdpPeer server, client;
    const std::string json = testing::TempDir() + "proxy_" + std::to_string(signal) + ".json";
    Program program({"proxy", "--listen", "127.0.0.1:0", "--to", io::to_text(server.address()), "--delay", "0.5",
                     "--seed", "9", "--json", json});
    const std::string line = program.line();
    ASSERT_TRUE(line.starts_with("listening on 127.0.0.1:")) << line;
    client.connect(*io::parse_address(line.substr(13), 1));
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(client.send("ping"));
      const auto got = server.receive();
      ASSERT_TRUE(got);
      ASSERT_TRUE(server.send_to(got->from, "pong"));
      ASSERT_EQ(client.receive()->bytes, "pong");
    }
    program.kill(signal);
    const std::string words = program.rest_of_out();
    EXPECT_EQ(program.exit_code(), 0);
    EXPECT_NE(words.find("10 in"), std::string::npos) << words;
    const auto report = nlohmann::json::parse(std::ifstream(json));
    EXPECT_EQ(report["up"]["in"], 10);
    EXPECT_EQ(report["down"]["out"], 10);
    EXPECT_EQ(report["seed"], 9);
    EXPECT_GE(report["up"]["delay_mean_ms"], 0.5);
    EXPECT_EQ(report["clients"].size(), 1U);
    EXPECT_EQ(report["lateness"]["count"], 20);
  }
}

TEST(Program, EndsTheProxyAfterItsDurationAndPrintsOnlyJson) {
  Program program({"proxy", "--to", "127.0.0.1:9", "--duration", "0.05", "--profile", "wifi-busy", "--json", "-"});
  const std::string out = program.rest_of_out();
  EXPECT_NE(program.rest_of_err().find("listening on 127.0.0.1:"), std::string::npos);
  EXPECT_EQ(program.exit_code(), 0);
  EXPECT_EQ(nlohmann::json::parse(out)["network"], "wifi-busy");
}

TEST(Program, ReportsAPortInUseWithARemedy) {
  UdpPeer taken;
  Program program({"proxy", "--listen", io::to_text(taken.address()), "--to", "127.0.0.1:9"});
  EXPECT_NE(program.rest_of_err().find("choose another port"), std::string::npos);
  EXPECT_EQ(program.exit_code(), 1);
}

TEST(Program, ReportsWrongArgumentsWithValueAndRange) {
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<Case> cases{
      {{}, "tandem-netsim: A subcommand is required"},
      {{"prox"}, "did you mean proxy?"},
      {{"proxy"}, "tandem-netsim proxy: --to is required"},
      {{"proxy", "--to", "127.0.0.1"}, "needs HOST:PORT"},
      {{"proxy", "--to", "127.0.0.1:0"}, "[1, 65535]"},
      {{"proxy", "--to", "127.0.0.1:9", "--listen", "127.0.0.1:9"}, "the proxy itself"},
      {{"proxy", "--to", "127.0.0.1:9", "--listen", "0.0.0.0:0"}, "not a loopback address"},
      {{"proxy", "--to", "192.0.2.1:9"}, "not a loopback address"},
      {{"proxy", "--to", "127.0.0.1:9", "--listen", "127.0.0.1:70000"}, "[0, 65535]"},
      {{"proxy", "--to", "127.0.0.1:9", "--delay", "60000.1"}, "[0, 60000] ms"},
      {{"proxy", "--to", "127.0.0.1:9", "--delay", "-1"}, "\"-1\" is out of range"},
      {{"proxy", "--to", "127.0.0.1:9", "--jitter", "nan"}, "\"nan\" is not a number"},
      {{"proxy", "--to", "127.0.0.1:9", "--loss", "100.5"}, "[0, 100] %"},
      {{"proxy", "--to", "127.0.0.1:9", "--loss", "5ms"}, "the unit is %"},
      {{"proxy", "--to", "127.0.0.1:9", "--duplicate", "1e400"}, "--duplicate"},
      {{"proxy", "--to", "127.0.0.1:9", "--seed", "1.5"}, "whole number"},
      {{"proxy", "--to", "127.0.0.1:9", "--duration", "0"}, "--duration"},
      {{"proxy", "--to", "127.0.0.1:9", "--outage", "5"}, "START,LENGTH"},
      {{"proxy", "--to", "127.0.0.1:9", "--outage", "5,1,0.5"}, "PERIOD must be longer"},
      {{"proxy", "--to", "127.0.0.1:9", "--outage", "5,x"}, "numbers of seconds"},
      {{"proxy", "--to", "127.0.0.1:9", "--profile", "wifi-bussy"}, "did you mean wifi-busy?"},
      {{"proxy", "--to", "127.0.0.1:9", "--profile", "./none.textproto"}, "No such file"},
      {{"proxy", "--to", "127.0.0.1:9", "--network", "lan", "--loss", "1"}, "excludes --loss"},
      {{"proxy", "--to", "127.0.0.1:9", "--json", "/no/such/folder/x.json"}, "cannot be written"},
      {{"proxy", "--to", "127.0.0.1:9", "--unknown", "1"}, "--unknown"},
      {{"profiles", "wifi-bussy"}, "did you mean wifi-busy?"},
      {{"profiles", "./none.textproto"}, "No such file"},
      {{"profiles", "5g", "--minutes", "0"}, "[0.05, 1440] min"},
      {{"profiles", "5g", "--svg", "/no/such/folder/x.svg"}, "cannot be written"},
      {{"profiles", "--svg", "x.svg"}, "need NAME"},
      {{"profiles", "4g-trace"}, "--capacity"},
      {{"profiles", "5g", "--capacity", "x.csv"}, "capacity"},
  };
  for (const Case& one : cases) {
    Program program(one.arguments);
    const std::string err = program.rest_of_err();
    EXPECT_EQ(program.exit_code(), 2) << one.says;
    EXPECT_NE(err.find(one.says), std::string::npos) << err;
    EXPECT_EQ(program.rest_of_out(), "") << one.says;
  }
}

TEST(Program, ReportsAllWrongOptionsAtOnce) {
  struct Case {
    std::vector<std::string> arguments, says;
  };
  const std::vector<Case> cases{
      {{"proxy", "--delay", "-1", "--loss=101", "--seed", "x", "--wrong"},
       {"--delay: \"-1\"", "--loss: \"101\"", "--seed: \"x\"", "--to is required", "--wrong", "5 mistakes"}},
      {{"run", "--channel", "magic", "--json"},
       {"--json: 1 required", "--channel: \"magic\" is unknown", "scene is required", "3 mistakes"}},
      {{"swarm", "--seeds", "0", "--jobs", "x"}, {"--seeds", "--jobs", "2 mistakes"}},
      {{"proxy", "--to", "127.0.0.1", "--listen", "0.0.0.0:1", "--profile", "wifi-bussy", "--outage", "5", "--log",
        "-"},
       {"--to: ", "not a loopback", "did you mean wifi-busy?", "--log needs a file", "4 mistakes"}},
      {{"swarm", "--trace", "-", "--json", "/no/such/x.json"}, {"--seeds 1", "name a file", "--json: ", "3 mistakes"}}};
  for (const Case& one : cases) {
    Program program(one.arguments);
    const std::string err = program.rest_of_err();
    EXPECT_EQ(program.exit_code(), 2) << err;
    for (const std::string& part : one.says) EXPECT_NE(err.find(part), std::string::npos) << part << " not in\n" << err;
    EXPECT_EQ(program.rest_of_out(), "");
  }
}

TEST(Program, ReportsAllMistakesInAFile) {
  const std::string file = testing::TempDir() + "bad.textproto";
  std::ofstream(file) << "version: 1\nboth {\n  flor_ms: 1\n  loss_percent: -1\n}\n";
  Program program({"proxy", "--to", "127.0.0.1:9", "--profile", file});
  const std::string err = program.rest_of_err();
  EXPECT_EQ(program.exit_code(), 2);
  EXPECT_NE(err.find(file + ":3:3: both.flor_ms: unknown key; did you mean floor_ms?"), std::string::npos) << err;
  EXPECT_NE(err.find(file + ":4:17: both.loss_percent = -1"), std::string::npos) << err;
}

TEST(Program, PrintsItsVersionProfilesAndUsage) {
  {
    Program program({"--version"});
    EXPECT_TRUE(program.rest_of_out().starts_with("tandem-netsim "));
    EXPECT_EQ(program.exit_code(), 0);
  }
  {
    Program program({"proxy", "--help"});
    EXPECT_NE(program.rest_of_out().find("Examples"), std::string::npos);
    EXPECT_EQ(program.exit_code(), 0);
  }
  {
    Program program({"profiles", "--json"});
    const auto json = nlohmann::json::parse(program.rest_of_out());
    EXPECT_EQ(program.exit_code(), 0);
    EXPECT_GE(json.size(), 6U);
    for (const auto& profile : json) EXPECT_FALSE(profile["summary"].get<std::string>().empty());
  }
  {
    // The printed text can be used as a file.
    Program program({"profiles", "5g", "--text"});
    const std::string file = testing::TempDir() + "mine.textproto";
    std::ofstream(file) << program.rest_of_out();
    EXPECT_EQ(program.exit_code(), 0);
    Program proxy({"proxy", "--to", "127.0.0.1:9", "--duration", "0.01", "--network", file});
    EXPECT_EQ(proxy.exit_code(), 0);
  }
}

TEST(Program, ShowsMeasuredBesidePromisedProfileValues) {
  const std::string svg = testing::TempDir() + "5g.svg";
  {
    Program program({"profiles", "5g", "--minutes", "2", "--svg", svg, "--ascii"});
    const std::string text = program.rest_of_out();
    EXPECT_EQ(program.exit_code(), 0);
    for (const char* says : {"5g, version", "source:", "log_normal", "promised", "for force feedback: ", "windows of",
                             "delay of the first 60 s", "lost", "delay of all 2.0 minutes"}) {
      EXPECT_NE(text.find(says), std::string::npos) << says << "\n" << text;
    }
    for (const char c : text) ASSERT_LT(static_cast<unsigned char>(c), 0x80) << "--ascii";
    std::ifstream drawn(svg);
    const std::string all{std::istreambuf_iterator<char>(drawn), {}};
    EXPECT_TRUE(all.starts_with("<?xml")) << all.substr(0, 80);
    EXPECT_TRUE(all.ends_with("</svg>\n"));
  }
  {
    Program program({"profiles", "random-loss-10", "--minutes", "1", "--json"});
    const auto json = nlohmann::json::parse(program.rest_of_out());
    EXPECT_EQ(program.exit_code(), 0);
    EXPECT_EQ(json["name"], "random-loss-10");
    EXPECT_NEAR(json["measured"]["up"]["lost_percent"].get<double>(), 10, 1);
    EXPECT_EQ(json["measured"]["up"]["p50_ms"], 10);
    EXPECT_EQ(json["quality"]["verdict"], "red");
    EXPECT_EQ(json["quality"]["up"]["windows"].size(), 3U);
  }
  {
    Program program({"profiles", "4g-trace", "--text"});  // the text needs no recording; playing it does
    EXPECT_NE(program.rest_of_out().find("capacity {}"), std::string::npos);
    EXPECT_EQ(program.exit_code(), 0);
  }
  {
    const std::string file = testing::TempDir() + "recorded.csv";
    std::ofstream(file) << "t_s[s],rtt_ms[ms]\n0,20\n0.5,\n0.6,40\n1,20\n";
    Program program({"profiles", file, "--minutes", "0.1", "--ascii"});
    const std::string text = program.rest_of_out();
    EXPECT_EQ(program.exit_code(), 0);
    EXPECT_NE(text.find("4 rows, 1 lost"), std::string::npos) << text;
    EXPECT_NE(text.find("each direction gets half"), std::string::npos) << text;
    EXPECT_NE(text.find("lost in the second"), std::string::npos) << text;
  }
}

TEST(Program, SuggestsTheNearestName) {
  for (const auto& [arguments, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"run", "one_axis", "--dealy", "5"}, "did you mean --delay?"},
           {{"run", "one_axis", "--profile", "WIFI-busy"}, "did you mean wifi-busy?"}}) {
    Program program(arguments);
    const std::string err = program.rest_of_err();
    EXPECT_EQ(program.exit_code(), 2);
    EXPECT_NE(err.find(says), std::string::npos) << err;
  }
}

TEST(Program, MeasuresFeelJudgesLimitsAndWritesJson) {
  Program good({"feel", "contact", "--channel", "set_position", "--plain-hands", "--seeds", "2", "--probe", "press",
                "--limit", "stiffness_felt_n_m>=150", "--json", "-", "--quiet"});
  const auto json = nlohmann::json::parse(good.rest_of_out());
  EXPECT_EQ(good.exit_code(), 0);
  EXPECT_NEAR(json["feel"]["stiffness_felt_n_m"]["mean"].get<double>(), 311, 4);
  EXPECT_EQ(json["seeds"].size(), 2u);
  EXPECT_TRUE(json["passed"].get<bool>());
  Program bad({"feel", "contact", "--channel", "set_position", "--plain-hands", "--seeds", "1", "--probe", "press",
               "--limit", "stiffness_felt_n_m>=360"});
  EXPECT_NE(bad.rest_of_out().find("FAIL stiffness_felt_n_m"), std::string::npos);
  EXPECT_EQ(bad.exit_code(), 1);
  Program wrong({"feel", "contact", "--probe", "pres", "--limit", "drag<=1"});
  const std::string err = wrong.rest_of_err();
  EXPECT_EQ(wrong.exit_code(), 2);
  EXPECT_NE(err.find("did you mean press?"), std::string::npos) << err;
  EXPECT_NE(err.find("2 mistakes"), std::string::npos) << err;
}

TEST(Program, ReportsThatTheFirstOutageOfAProfileIsAfterTheRun) {
  const std::string said = "note: the first periodic outage at 10 s ";
  for (const auto& [more, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{}, "came after the end of the run, 3."},
           {{"--check"}, "will not come, unless the session of 3 s begins later than at 7 s of network time"}}) {
    std::vector<std::string> arguments{"run", "one_axis", "--duration", "3", "--profile", "outage"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Program program(arguments);
    const std::string out = program.rest_of_out();
    EXPECT_EQ(program.exit_code(), 0);
    EXPECT_NE(out.find(said + says), std::string::npos) << out;
    EXPECT_EQ(out.find(said), out.rfind(said)) << "it is one outage for both directions\n" << out;
  }
  Program lived({"run", "one_axis", "--duration", "11", "--profile", "outage"});
  const std::string out = lived.rest_of_out();
  EXPECT_EQ(out.find("periodic outage"), std::string::npos) << out;
}

TEST(Program, RequiresADurationForASceneWithoutAnEnd) {
  for (const char* command : {"run", "sweep"}) {
    std::vector<std::string> arguments{command, "lesson"};
    if (arguments[0] == "sweep") arguments.insert(arguments.end(), {"--delay", "0"});
    Program refused(arguments);
    EXPECT_NE(refused.rest_of_err().find("--duration: the scene lesson has no end"), std::string::npos);
    EXPECT_EQ(refused.exit_code(), 2) << command;
  }
  Program lived({"run", "lesson", "--duration", "3"});
  const std::string out = lived.rest_of_out();
  EXPECT_NE(out.find("lesson: pass, 3.0 s"), std::string::npos) << out;
  EXPECT_NE(out.find("whole session"), std::string::npos) << out;
  EXPECT_NE(out.find("judged: "), std::string::npos) << out;
}

TEST(Program, ReportsNotJudgedForATooShortRun) {
  Program program({"run", "contact", "--duration", "0.5"});
  const std::string out = program.rest_of_out();
  EXPECT_NE(out.find("contact: not judged, 0.5 s"), std::string::npos) << out;
  EXPECT_EQ(program.exit_code(), 0);
}

TEST(Program, PrintsDashesForAPhaseNotReached) {
  Program program({"run", "contact", "--duration", "1"});
  std::istringstream lines(program.rest_of_out());
  std::size_t dashes = 0, zeros = 0;
  for (std::string line; std::getline(lines, line);) {
    dashes += line.ends_with("      -      -") ? 1 : 0;
    zeros +=
        !line.contains("all phases") && !line.contains("outside phases") && line.ends_with("   0.00   0.00") ? 1 : 0;
  }
  EXPECT_GT(dashes, 0u);
  EXPECT_EQ(zeros, 0u);
}

TEST(Program, ReportsProfilesWithoutPromises) {
  Program without({"profiles", "lan", "--minutes", "0.1"}), with({"profiles", "geo-satellite", "--minutes", "0.1"});
  const std::string none = without.rest_of_out(), some = with.rest_of_out();
  EXPECT_NE(none.find("no quantiles promised"), std::string::npos) << none;
  EXPECT_EQ(some.find("no quantiles promised"), std::string::npos) << some;
  EXPECT_NE(some.find("  promised"), std::string::npos) << some;
}

TEST(Program, JudgesTheNetworkSeparatelyFromTheSession) {
  {
    Program program({"run", "one_axis", "--duration", "5", "--outage", "3,0.4", "--json", "-"});
    const auto json = nlohmann::json::parse(program.rest_of_out());
    const std::string words = program.rest_of_err();
    EXPECT_EQ(program.exit_code(), 0);
    for (const auto& seat : json["seats"]) {
      EXPECT_EQ(seat["quality"]["up"]["lost"], 400) << seat["name"];
      EXPECT_NEAR(seat["quality"]["up"]["longest_gap_ms"].get<double>(), 401, 1.01);
      EXPECT_EQ(seat["quality"]["verdict"], "red");
    }
    EXPECT_NE(words.find("network of"), std::string::npos) << words;
    EXPECT_NE(words.find("40 % lost in the second to"), std::string::npos) << words;
  }
  {
    Program program({"run", "one_axis", "--duration", "2", "--no-quality", "--json", "-", "--quiet"});
    const auto json = nlohmann::json::parse(program.rest_of_out());
    EXPECT_EQ(program.exit_code(), 0);
    EXPECT_FALSE(json["seats"][0].contains("quality"));
  }
  {
    Program program({"run", "one_axis", "--duration", "2"});
    EXPECT_NE(program.rest_of_out().find("network: green for trainer"), std::string::npos);
    EXPECT_EQ(program.exit_code(), 0);
  }
}

}  // namespace
}  // namespace tandem::netsim
