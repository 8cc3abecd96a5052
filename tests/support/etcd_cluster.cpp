#include "tests/support/etcd_cluster.h"

#include <signal.h>
#include <stdlib.h>

#include <filesystem>
#include <stdexcept>

#include "common/base/format.h"
#include "common/io/tcp_listener.h"

namespace tandem::test {
namespace {

std::string name_of(std::size_t member) { return "member" + std::to_string(member); }

}  // namespace

std::string EtcdCluster::program() {
  const char* const path = "/usr/bin/etcd";
  return std::filesystem::exists(path) ? path : "";
}

EtcdCluster::EtcdCluster(std::size_t members) {
  std::string folder = (std::filesystem::temp_directory_path() / "tandem-etcd-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = folder;
  // Ports that are free at this moment, held until all are known: etcd takes no port 0.
  std::vector<io::TcpListener> held;
  for (std::size_t i = 0; i < 2 * members; ++i) {
    auto listener = io::listen_tcp(io::parse_address("127.0.0.1:0", 0).value());
    if (!listener) throw std::runtime_error("no free port");
    (i < members ? endpoints_ : peers_).push_back(format("127.0.0.1:%d", listener->local.port()));
    held.push_back(std::move(*listener));
  }
  held.clear();
  for (std::size_t i = 0; i < members; ++i) initial_ += (i == 0 ? "" : ",") + name_of(i) + "=http://" + peers_[i];
  for (std::size_t i = 0; i < members; ++i) members_.push_back(start(i));
}

EtcdCluster::~EtcdCluster() {
  members_.clear();
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Process EtcdCluster::start(std::size_t i) const {
  const std::string peer = "http://" + peers_[i], client = "http://" + endpoints_[i];
  return Process({program(), "--name", name_of(i), "--data-dir", data(i), "--listen-client-urls", client,
                  "--advertise-client-urls", client, "--listen-peer-urls", peer, "--initial-advertise-peer-urls", peer,
                  "--initial-cluster", initial_, "--logger", "zap", "--log-level", "error"});
}

void EtcdCluster::kill(std::size_t i) {
  members_[i].signal(SIGKILL);
  static_cast<void>(members_[i].wait());
}

void EtcdCluster::restart(std::size_t i) { members_[i] = start(i); }

std::string EtcdCluster::data(std::size_t i) const { return folder_ + "/" + name_of(i); }

}  // namespace tandem::test
