#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/base/format.h"
#include "server/directory/io/etcd_directory.h"
#include "tests/io/free_address.h"
#include "tests/io/programs.h"

namespace tandem::test {

/// Path of a program of Debian's etcd packages; empty if it is missing.
inline std::string etcd_program(const char* name) {
  const std::string path = std::string("/usr/bin/") + name;
  return std::filesystem::exists(path) ? path : "";
}

inline constexpr const char* kNoEtcd = "etcd is not installed (Debian: etcd-server, etcd-client)";

/// A directory with a thread-free interface for tests: begins an operation and waits for its reply.
inline directory::Reply wait_for_reply(directory::Directory& in, directory::OperationId operation,
                                       std::vector<directory::Reply>* others = nullptr) {
  const auto end = std::chrono::steady_clock::now() + Process::kTimeout;
  while (std::chrono::steady_clock::now() < end) {
    if (auto reply = in.poll()) {
      if (reply->operation == operation) return *reply;
      if (others != nullptr) others->push_back(std::move(*reply));
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  ADD_FAILURE() << "operation " << operation << " has no reply";
  return {};
}

/// A port of free_address(); etcd takes no port 0. With an ephemeral port, a server that looks for an etcd that was
/// ended could get this port itself, connect to itself, and so keep etcd from starting again.
inline int free_port() {
  const std::string address = free_address();
  return std::stoi(address.substr(address.find(':') + 1));
}

/// A member of etcd on loopback, with its own ports and data folder, ended at the end of the test.
class Etcd {
 public:
  /// @param tls  further arguments; not empty: clients use TLS
  explicit Etcd(Words tls = {}) : Etcd("test", free_port(), {}, std::move(tls)) {}
  /// A member of a cluster. @param cluster  NAME=URL of all members with commas; empty: it is alone
  Etcd(const std::string& name, int peer, std::string cluster, Words more = {}) : client_(free_port()) {
    const std::string scheme = more.empty() ? "http" : "https";
    const std::string peers = format("http://127.0.0.1:%d", peer), clients = scheme + "://" + endpoint();
    if (cluster.empty()) cluster = name + "=" + peers;
    command_ = {etcd_program("etcd"),
                "--name",
                name,
                "--data-dir",
                folder_.file("data"),
                "--listen-client-urls",
                clients,
                "--advertise-client-urls",
                clients,
                "--listen-peer-urls",
                peers,
                "--initial-advertise-peer-urls",
                peers,
                "--initial-cluster",
                cluster,
                "--logger",
                "zap",
                "--log-level",
                "error"};
    command_.insert(command_.end(), more.begin(), more.end());
    start();
  }
  /// Starts the member with its old data, after it was ended.
  void start() { process_.emplace(command_); }
  /// Ends the member, and starts it with its old data and further arguments.
  void restart_with(const Words& more) {
    process_->signal(SIGTERM);
    EXPECT_TRUE(process_->wait());
    command_.insert(command_.end(), more.begin(), more.end());
    start();
  }
  /// Ends the member, which is alone, and starts it with the data of a backup. @param file  of `etcdctl snapshot save`
  void restore(const std::string& file) {
    process_->signal(SIGTERM);
    EXPECT_TRUE(process_->wait());
    const auto data = std::ranges::find(command_, "--data-dir") + 1;
    *data = folder_.file("restored");
    Process restored({etcd_program("etcdctl"), "snapshot", "restore", file, "--data-dir", *data});
    EXPECT_EQ(restored.wait(), 0) << restored.err();
    start();
  }
  /// Kills the member, which is alone. It comes back after `outage` with no data.
  void lose(std::chrono::milliseconds outage) {
    process_->signal(SIGKILL);
    EXPECT_TRUE(process_->wait());
    std::this_thread::sleep_for(outage);
    *(std::ranges::find(command_, "--data-dir") + 1) = folder_.file(format("data-%d", ++losses_));
    start();
  }
  [[nodiscard]] std::string endpoint() const { return format("127.0.0.1:%d", client_); }
  [[nodiscard]] Process& process() { return *process_; }
  [[nodiscard]] const Folder& folder() const { return folder_; }

  /// Waits until the member answers. Returns the first operation number that is free.
  directory::OperationId wait_until_ready(directory::Directory& through, directory::OperationId first = 1) {
    for (directory::OperationId n = first; n <= first + 300; ++n) {
      through.begin(n, directory::Transaction{});
      if (wait_for_reply(through, n).outcome == directory::Outcome::kDone) return n + 1;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ADD_FAILURE() << "etcd does not answer: " << process_->err();
    return first + 1000;
  }

  /// Reads a key, or all with a prefix, by Debian's etcdctl.
  [[nodiscard]] std::string etcdctl(Words arguments) const {
    arguments.insert(arguments.begin(), {etcd_program("etcdctl"), "--endpoints", endpoint()});
    Process process(std::move(arguments));
    EXPECT_EQ(process.wait(), 0) << process.err();
    return process.out();
  }

 private:
  Folder folder_;
  int client_ = 0, losses_ = 0;
  Words command_;
  std::optional<Process> process_;
};

/// Members of one etcd cluster on loopback.
class EtcdCluster {
 public:
  /// @param members  1 to 9
  /// @param tls      further arguments of each; not empty: clients use TLS
  explicit EtcdCluster(std::size_t members, const Words& tls = {}) {
    std::vector<int> peers;
    std::string all;
    for (std::size_t n = 0; n < members; ++n) {
      peers.push_back(free_port());
      all += (n == 0 ? "" : ",") + format("m%zu=http://127.0.0.1:%d", n, peers.back());
    }
    for (std::size_t n = 0; n < members; ++n)
      members_.push_back(std::make_unique<Etcd>(format("m%zu", n), peers[n], members == 1 ? "" : all, tls));
  }
  [[nodiscard]] Etcd& member(std::size_t n) const { return *members_.at(n); }
  [[nodiscard]] std::size_t size() const noexcept { return members_.size(); }
  /// Number of the member that leads now; the test fails if there is none within 10 s.
  [[nodiscard]] std::size_t leader() const {
    for (int tries = 0; tries < 100; ++tries) {
      for (std::size_t n = 0; n < members_.size(); ++n) {
        Process asked(
            {etcd_program("etcdctl"), "--endpoints", members_[n]->endpoint(), "endpoint", "status", "-w", "json"});
        if (asked.wait() != 0) continue;
        const Json all = Json::parse(asked.out(), nullptr, false);
        if (!all.is_array() || all.empty()) continue;
        const Json status = all[0]["Status"];
        if (status["leader"] == status["header"]["member_id"]) return n;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ADD_FAILURE() << "no member of etcd leads";
    return 0;
  }
  [[nodiscard]] std::vector<std::string> endpoints() const {
    std::vector<std::string> all;
    for (const auto& member : members_) all.push_back(member->endpoint());
    return all;
  }

 private:
  std::vector<std::unique_ptr<Etcd>> members_;
};

}  // namespace tandem::test
