#pragma once

#include <chrono>
#include <csignal>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/io/etcd_process.h"
#include "tests/io/free_address.h"
#include "tests/io/multi_client_fixture.h"

namespace tandem::test {

/// How one server of a service differs from the others.
struct MemberSetup {
  Words under{};                         ///< a program, and its arguments, that starts the server
  std::string address{};                 ///< where clients reach it; empty: where it listens
  std::vector<std::string> endpoints{};  ///< of etcd; empty: all members
  std::string directory{};               ///< further fields of block `directory`
  Words vouch{};                         ///< further arguments of `service vouch`, for the first start
};

/// Servers of one service over etcd, all on loopback: `a`, `b` and so on. Each has its own keys and a voucher.
class LiveService {
 public:
  /// @param sessions  of the configuration of all servers  @param etcds  1 or 3
  /// @param tls       further arguments of etcd, with which clients use TLS
  explicit LiveService(std::string sessions, std::size_t etcds = 1, int ttl_s = 3, const Words& tls = {})
      : sessions_(std::move(sessions)), ttl_s_(ttl_s), etcd_(etcds, tls) {
    run({"service", "init", folder_.file("service")});
  }

  /// From the next start of a server on, its sessions move to less used servers by themselves.
  void let_balance() { balance_ = true; }
  /// Sets how a server differs, from its next start on.
  void set(const std::string& name, MemberSetup setup) { setups_[name] = std::move(setup); }
  /// Address at which a server listens, or will listen.
  [[nodiscard]] std::string address(const std::string& name) {
    if (addresses_[name].empty()) addresses_[name] = free_address();  // clients know it, so a restart has the same
    return addresses_[name];
  }
  /// Address of a server's metrics.
  [[nodiscard]] std::string metrics(const std::string& name) {
    if (metrics_[name].empty()) metrics_[name] = free_address();
    return metrics_[name];
  }

  /// Makes keys and member file of a server, and starts it.
  Process& start(const std::string& name) {
    if (!std::filesystem::exists(folder_.file(name))) {
      const std::string init = run({"init", "--state", folder_.file(name)});
      const std::string member = folder_.file(name + ".member");
      Words vouch{"service", "vouch", folder_.file("service"), "--name", name, "--key", key_in(init), "--out", member};
      vouch.insert(vouch.end(), setups_[name].vouch.begin(), setups_[name].vouch.end());
      run(std::move(vouch));
      run({"service", "join", member, "--state", folder_.file(name)});
    }
    const MemberSetup& setup = setups_[name];
    std::string directory = setup.directory;
    for (const std::string& endpoint : setup.endpoints.empty() ? etcd_.endpoints() : setup.endpoints)
      directory += " endpoint: \"" + endpoint + "\"";
    if (!setup.address.empty()) directory += " address: \"" + setup.address + "\"";
    const std::string config =
        folder_.write(name + ".textproto", "version: 1 listen: \"" + address(name) + "\" metrics: \"" + metrics(name) +
                                               "\" state: \"" + name + "\" " + sessions_ + " directory { " + directory +
                                               format(" ttl_s: %d balance: %s }", ttl_s_, balance_ ? "true" : "false"));
    Words command = setup.under;
    command.insert(command.end(), {TANDEM_SERVER, "serve", config});
    servers_[name] = std::make_unique<Process>(std::move(command));
    EXPECT_TRUE(servers_[name]->wait_for("Ctrl-C ends")) << servers_[name]->err();
    return *servers_[name];
  }
  [[nodiscard]] Process& of(const std::string& name) const { return *servers_.at(name); }
  [[nodiscard]] Etcd& etcd(std::size_t n = 0) { return etcd_.member(n); }
  [[nodiscard]] EtcdCluster& etcds() { return etcd_; }
  [[nodiscard]] const Folder& folder() const { return folder_; }

  /// Sessions that a server serves, as JSON.
  [[nodiscard]] Json sessions(const std::string& name) const {
    Process asked = server({"sessions", "--json", "--state", folder_.file(name)});
    EXPECT_EQ(asked.wait(), 0) << asked.err();
    const Json list = Json::parse(asked.out(), nullptr, false);
    return list.is_discarded() ? Json() : list["sessions"];
  }
  /// Waits until a server serves this number of sessions. @return time that it took; the test fails after 30 s
  double wait_for_sessions(const std::string& name, std::size_t count) const {
    const auto began = std::chrono::steady_clock::now();
    const auto taken = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(); };
    while (sessions(name).size() != count) {
      if (taken() > 30) {
        ADD_FAILURE() << name << " does not serve " << count << " sessions: " << servers_.at(name)->err();
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return taken();
  }
  /// Enrols a workstation at the first server, and waits until all have it. @return the folder of its keys
  [[nodiscard]] std::string enrolled(const std::string& workstation) const {
    const std::string own = enrolled_at(servers_.begin()->first, workstation);
    for (const auto& [name, process] : servers_) {
      const std::string list = folder_.file(name) + "/workstations.textproto";
      const auto has = [&] {
        return std::filesystem::exists(list) &&
               folder_.read(name + "/workstations.textproto").find(workstation) != std::string::npos;
      };
      for (int i = 0; i < 1500 && !has(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      EXPECT_TRUE(has()) << name << " does not learn the workstation: " << process->err();
    }
    return own;
  }
  /// Enrols a workstation at one server, which tells the others within a second. @return the folder of its keys
  [[nodiscard]] std::string enrolled_at(const std::string& name, const std::string& workstation) const {
    const std::string own = folder_.file("own-" + workstation);
    Process given = server({"enroll", workstation, "--state", folder_.file(name)});
    EXPECT_EQ(given.wait(), 0) << given.err();
    Process taken({TANDEM_CLIENT, "enroll", first_line(given.out()), "--state", own});
    EXPECT_EQ(taken.wait(), 0) << taken.err();
    return own;
  }
  /// Runs a command of tandem-server to its end. @return standard output
  static std::string run(Words words) {
    Process process = server(std::move(words));
    EXPECT_EQ(process.wait(), 0) << process.err();
    return process.out();
  }

 private:
  /// The server's key in the output of `init`: the longest word.
  static std::string key_in(const std::string& text) {
    std::istringstream words(text);
    std::string longest;
    for (std::string word; words >> word;)
      if (word.size() > longest.size() && word.find('/') == std::string::npos) longest = word;
    return longest;
  }

  std::string sessions_;
  int ttl_s_;
  bool balance_ = false;
  Folder folder_;
  EtcdCluster etcd_;
  std::map<std::string, std::string> addresses_, metrics_;
  std::map<std::string, MemberSetup> setups_;
  std::map<std::string, std::unique_ptr<Process>> servers_;
};

}  // namespace tandem::test
