#pragma once

#include <poll.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "common/auth/io/control_client.h"
#include "common/auth/io/server_keystore.h"
#include "common/auth/io/service_keystore.h"
#include "common/base/format.h"
#include "common/io/socket_address.h"
#include "proto/rpc/rpc_messages.h"
#include "tests/io/etcd_process.h"

namespace tandem::bench {

using namespace std::chrono_literals;

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(1);
}

inline constexpr const char* kWorkstation = "bench";
inline auth::Identity make_workstation() {
  return auth::Identity::make(kWorkstation, auth::random_bytes<auth::Id16>(), auth::wall_seconds());
}

/// A server with sessions of its own, named lessonN-M.
struct Host {
  std::string state;
  io::SocketAddress address;
  std::unique_ptr<test::Process> process;
  std::unique_ptr<auth::ServerKeystore> keys;
  std::vector<rpc::Id> sessions;
};

/// Servers of TANDEM_SERVER, members of one service or each alone. One workstation is enrolled.
class Hosts {
 public:
  struct Wanted {
    std::string folder;  ///< new
    std::size_t servers = 1, sessions = 1;
  };
  /// @param etcd  directory of the service; null: each server is alone
  Hosts(const Wanted& wanted, const auth::Identity& workstation, const test::EtcdCluster* etcd) {
    const std::string& folder = wanted.folder;
    std::filesystem::create_directories(folder);
    const std::int64_t now = auth::wall_seconds();
    if (etcd != nullptr && !auth::ServiceKeystore::init(folder + "/service")) fail("no service folder");
    for (std::size_t n = 0; n < wanted.servers; ++n) {
      Host& host = hosts_.emplace_back();
      host.state = folder + "/state" + std::to_string(n);
      const auto key = auth::ServerKeystore::init(host.state, now);
      if (!key) fail(key.error());
      std::string directory;
      if (etcd != nullptr) {
        const auto service = auth::ServiceKeystore::open(folder + "/service");
        const auto member =
            service->vouch({"server" + std::to_string(n), *key, now - 3600, now + 100 * auth::Voucher::kDay});
        if (!member) fail(member.error());
        if (const auto joined = auth::ServerKeystore::join_service(host.state, member->bytes(), "member", now); !joined)
          fail(joined.error());
        directory = "directory {";
        for (const std::string& endpoint : etcd->endpoints()) directory += " endpoint: \"" + endpoint + "\"";
        directory += " }\n";
      }
      auto keys = auth::ServerKeystore::open(host.state);
      if (!keys) fail(keys.error());
      host.keys = std::make_unique<auth::ServerKeystore>(std::move(*keys));
      static_cast<void>(
          host.keys->registry().enroll_without_code({kWorkstation, workstation.fingerprint().sha256, now}));
      const std::string address = format("127.0.0.1:%d", test::free_port()), config = host.state + ".textproto";
      host.address = *io::parse_address(address, 1);
      std::string sessions;
      for (std::size_t m = 0; m < wanted.sessions; ++m)
        sessions += "session { name: \"" + name_of(n, m) + "\" scene: \"free_motion\" duration_s: 3e6 }\n";
      std::ofstream(config) << "version: 1\nlisten: \"" << address << "\"\nstate: \"" << host.state << "\"\n"
                            << sessions << directory;
      host.process = std::make_unique<test::Process>(std::vector<std::string>{TANDEM_SERVER, "serve", config});
      if (!host.process->wait_for("Ctrl-C ends")) fail(host.process->out() + host.process->err());
    }
    for (std::size_t n = 0; n < wanted.servers; ++n)
      for (std::size_t m = 0; m < wanted.sessions; ++m) find_session(hosts_[n], name_of(n, m), workstation);
  }
  [[nodiscard]] static std::string name_of(std::size_t server, std::size_t session) {
    return format("lesson%zu-%zu", server, session);
  }
  [[nodiscard]] const Host& operator[](std::size_t n) const { return hosts_[n]; }

 private:
  static void find_session(Host& host, const std::string& name, const auth::Identity& workstation) {
    for (int tries = 0; tries < 200; ++tries) {
      auto client =
          auth::ControlClient::connect(host.address, [&](const auth::KeyFingerprint&) { return &workstation; }, 5s, -1);
      if (client)
        if (const auto reply = client->ask(rpc::SessionListRequest{}, 5s))
          if (const auto* const list = std::get_if<rpc::SessionList>(&*reply))
            for (const rpc::ListedSession& session : list->sessions)
              if (session.name == name) {
                host.sessions.push_back(session.id);
                return;
              }
      ::poll(nullptr, 0, 50);
    }
    fail("no session " + name);
  }

  std::vector<Host> hosts_;
};

}  // namespace tandem::bench
