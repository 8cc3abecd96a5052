// Runs README's commands from an installed package to two enrolled workstations that join. The server and the
// workstations run in two network namespaces of this machine, connected only by a virtual cable. Needs root, and
// removes everything that it created.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "tests/io/programs.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIp = "/usr/sbin/ip";

/// Runs `ip` with arguments. @return empty on success, else its output and errors
std::string ip(Words words) {
  words.insert(words.begin(), kIp);
  Process process(std::move(words));
  return process.wait() == 0 ? "" : process.out() + process.err() + " ";
}

/// Two network namespaces and a virtual cable (veth). The server's end is 10.213.7.1, the workstations' end 10.213.7.2.
class Cable {
 public:
  Cable()
      : server_("tandem-" + std::to_string(getpid()) + "-s"),
        workstation_("tandem-" + std::to_string(getpid()) + "-w") {
    const std::string number = std::to_string(getpid() % 100000), a = "tds" + number, b = "tdw" + number;
    problem += ip({"netns", "add", server_});
    problem += ip({"netns", "add", workstation_});
    problem += ip({"link", "add", a, "netns", server_, "type", "veth", "peer", "name", b, "netns", workstation_});
    for (const auto& [space, end, address] :
         {std::tuple{server_, a, "10.213.7.1/24"}, std::tuple{workstation_, b, "10.213.7.2/24"}})
      for (const Words& words : {Words{"addr", "add", address, "dev", end}, Words{"link", "set", end, "up"},
                                 Words{"link", "set", "lo", "up"}}) {
        Words all{"-n", space};
        all.insert(all.end(), words.begin(), words.end());
        problem += ip(std::move(all));
      }
  }
  ~Cable() {
    static_cast<void>(ip({"netns", "del", workstation_}));
    static_cast<void>(ip({"netns", "del", server_}));
  }
  Cable(const Cable&) = delete;
  Cable& operator=(const Cable&) = delete;
  [[nodiscard]] Process at_server(Words words) const { return in(server_, TANDEM_SERVER, std::move(words)); }
  [[nodiscard]] Process at_workstation(Words words) const { return in(workstation_, TANDEM_CLIENT, std::move(words)); }
  std::string problem;  ///< output of the commands that failed; empty: both ends exist

 private:
  static Process in(const std::string& space, const std::string& program, Words words) {
    words.insert(words.begin(), {kIp, "netns", "exec", space, program});
    return Process(std::move(words));
  }
  std::string server_, workstation_;
};

std::string said(Process process) {
  EXPECT_EQ(process.wait(), 0) << process.out() << process.err();
  return process.out().substr(0, process.out().find('\n'));
}

TEST(TwoMachines, InitEnrolServeAndJoinAcrossACable) {
  if (::getuid() != 0) GTEST_SKIP() << "needs root, for network namespaces";
  if (!fs::exists(kIp)) GTEST_SKIP() << "ip is not installed (apt install iproute2)";
  const Cable cable;
  if (!cable.problem.empty()) GTEST_SKIP() << "no network namespaces here: " << cable.problem;
  const Folder folder;
  const std::string at = "10.213.7.1:7000", state = folder.file("state");
  fs::create_directory(folder.file("reports"));
  const std::string config =
      folder.write("server.textproto",
                   "version: 1 listen: \"0.0.0.0:7000\" state: \"state\" reports: \"reports\"\n"
                   "session { name: \"lab\" scene: \"free_motion\" duration_s: 4 restart: false }\n");
  // Without keys the server rejects a network address.
  Process early = cable.at_server({"serve", config});
  EXPECT_EQ(early.wait(), 2);
  EXPECT_NE(early.err().find("tandem-server init"), std::string::npos) << early.err();

  said(cable.at_server({"init", "--state", state}));
  const std::string first = said(cable.at_server({"enroll", "desk-1", "--address", at, "--state", state}));
  const std::string second = said(cable.at_server({"enroll", "desk-2", "--address", at, "--state", state}));
  Process host = cable.at_server({"serve", config});
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  said(cable.at_workstation({"enroll", first, "--state", folder.file("desk-1")}));
  said(cable.at_workstation({"enroll", second, "--state", folder.file("desk-2")}));

  Process asked = cable.at_server({"sessions", "--json", "--state", state});
  EXPECT_EQ(asked.wait(), 0) << asked.err();
  const Json lobby = Json::parse(asked.out(), nullptr, false);
  ASSERT_FALSE(lobby.is_discarded()) << asked.out();
  const std::string code = lobby["sessions"][0]["code"].get<std::string>();
  const std::string ticket = said(cable.at_server(
      {"ticket", "--session", "lab", "--seat", "trainer", "--workstation", "desk-1", "--state", state}));
  Process listed = cable.at_workstation({"sessions", "--server", at, "--state", folder.file("desk-2")});
  EXPECT_EQ(listed.wait(), 0) << listed.err();
  EXPECT_NE(listed.out().find("lab: waiting"), std::string::npos) << listed.out();

  Process trainer = cable.at_workstation({"join", "--server", at, "--seat", "trainer", "--device", "sim", "--ticket",
                                          ticket, "--state", folder.file("desk-1")});
  Process trainee = cable.at_workstation({"join", "--server", at, "--session", code, "--seat", "trainee", "--device",
                                          "sim", "--state", folder.file("desk-2")});
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << "its only session is over and does not restart\n" << host.err();
  Json report;
  for (const auto& entry : fs::directory_iterator(folder.file("reports")))
    report = folder.json("reports/" + entry.path().filename().string());
  ASSERT_TRUE(report.is_object()) << "no report";
  EXPECT_EQ(report["violations"], Json::array());
  EXPECT_EQ(report["ended_by"], "scene");
}

}  // namespace
}  // namespace tandem::test
