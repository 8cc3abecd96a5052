#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/directory/model_store.h"
#include "server/service/service_member.h"

namespace tandem::server::test {

using namespace std::chrono_literals;

/// A session with this number in its id and code.
inline ServiceSession session_spec(int number, const std::string& scene = "scene text") {
  ServiceSession spec;
  spec.id[0] = static_cast<std::byte>(number);
  spec.code = "CODE00000" + std::to_string(number % 10);
  spec.scene = scene;
  spec.scene_name = "contact";
  return spec;
}

/// A directory that may be cut off: requests end without an answer, and watches break.
class CuttableDirectory final : public directory::Directory {
 public:
  explicit CuttableDirectory(directory::ModelStore& store) : inner_(store) {}
  void begin(directory::OperationId operation, const directory::Request& request) override {
    const auto* const transaction = std::get_if<directory::Transaction>(&request);
    const auto writes = [](const directory::Step& step) { return std::holds_alternative<directory::Put>(step); };
    if (cut || (grants_nothing && std::holds_alternative<directory::Grant>(request)) ||
        (full && transaction != nullptr && std::ranges::any_of(transaction->then, writes)))
      return unknown(operation);
    if (std::holds_alternative<directory::Watch>(request)) watches_.push_back(operation);
    inner_.begin(operation, request);
  }
  std::optional<directory::Reply> poll() override {
    if (cut) {
      for (const auto watch : std::exchange(watches_, {})) unknown(watch);
      while (inner_.poll()) {
      }
    }
    if (!unknown_.empty()) {
      directory::Reply reply = std::move(unknown_.back());
      unknown_.pop_back();
      return reply;
    }
    auto reply = inner_.poll();
    while (reply && answers_lost) reply = inner_.poll();
    return reply;
  }
  bool cut = false, answers_lost = false, grants_nothing = false;
  bool full = false;  ///< as etcd at its quota: it renews leases and answers reads, and writes nothing

 private:
  void unknown(directory::OperationId operation) {
    directory::Reply reply;
    reply.operation = operation;
    reply.outcome = directory::Outcome::kUnknown;
    reply.reason = "cut off";
    unknown_.push_back(std::move(reply));
  }
  directory::ModelDirectory inner_;
  std::vector<directory::OperationId> watches_;
  std::vector<directory::Reply> unknown_;
};

/// Servers of one service in virtual time. Each does what its member says: it opens and gives up sessions at once.
class ServiceTest : public testing::Test {
 protected:
  ServiceTest() { know_each_other(); }
  /// All servers that are started from now on know the present directory from before.
  void know_each_other() {
    const directory::Reply written =
        store_.execute(1, directory::Transaction{{}, {directory::Put{"/tandem/v1/registry/.mark", "known"}}, {}});
    agreed_ = {.mark = "known", .entries = {}, .created = written.revision};
  }
  struct Server {
    Server(directory::ModelStore& store, ServiceMemberOptions options)
        : directory(store), member(std::move(options), directory) {}
    CuttableDirectory directory;
    ServiceMember member;
    std::map<std::string, ServiceEvent> open;  ///< sessions that it serves
    std::vector<ServiceEvent> events;
    bool opens = true, runs = true;
    bool waits = true;  ///< no person has come since it has reported that its sessions wait
  };
  Server& start(const std::string& name, std::map<std::string, ServiceSession> configured = {},
                const std::string& zone = {}, bool balance = true) {
    servers_.push_back(std::make_unique<Server>(store_, ServiceMemberOptions{.server = name,
                                                                             .key = RandomKey{servers_.size()},
                                                                             .configured = std::move(configured),
                                                                             .agreed = agreed_,
                                                                             .balance = balance}));
    servers_.back()->member.describe(
        {.address = name + ":7000", .key = "k", .version = "1", .zone = zone, .capacity = 4});
    pass(1s);
    return *servers_.back();
  }
  void act(Server& server) {
    while (auto event = server.member.sessions().poll_event()) {
      server.events.push_back(*event);
      if (event->kind == ServiceEvent::Kind::kGiveUp) {
        server.open.erase(event->session);
        server.member.sessions().on_given_up(event->session);
      } else if (event->kind == ServiceEvent::Kind::kHandOver) {
        if (event->waits && !server.waits) {
          if (on_ask) on_ask(event->session);
          server.member.moves().on_kept(event->session);
          continue;
        }
        server.open.erase(event->session);
        if (on_hand_over) on_hand_over(server);
        server.member.sessions().set_snapshot(event->session, "state at the hand-over");
        server.member.moves().on_handed_over(now_, event->session);
      } else if (event->kind == ServiceEvent::Kind::kOpen && !server.opens) {
        server.member.sessions().on_open_failed(now_, event->session);
      } else if (event->kind == ServiceEvent::Kind::kOpen) {
        server.open[event->session] = *event;
        server.member.sessions().on_opened(event->session);
      }
    }
  }
  void settle() {
    store_.advance(now_);
    for (int round = 0; round < 10; ++round)
      for (const auto& server : servers_) {
        if (!server->runs) continue;
        server->member.step(now_);
        act(*server);
      }
  }
  void pass(Duration time) {
    for (const Time end = now_ + time; now_ < end;) {
      now_ += 20ms;
      settle();
      check_single_actor();
    }
  }
  /// No session may have effort on two servers.
  void check_single_actor() {
    std::map<std::string, std::string> acting;
    for (const auto& server : servers_)
      for (const auto& [name, event] : server->open) {
        const auto until = server->member.served_until();
        if (!until || now_ >= *until) continue;
        EXPECT_TRUE(acting.emplace(name, "").second) << name << " has two owners at " << seconds(now_);
      }
  }
  bool has(const std::string& key) const { return store_.entries().contains("/tandem/v1/" + key); }
  std::string value(const std::string& key) const {
    const auto found = store_.entries().find("/tandem/v1/" + key);
    return found == store_.entries().end() ? "" : found->second.value;
  }
  void order_move(const std::string& session, const std::string& server) {
    static_cast<void>(store_.execute(
        1, directory::Transaction{{}, {directory::Put{"/tandem/v1/catalogue/" + session + "/move", server}}, {}}));
  }
  static rpc::SessionChoice named(const std::string& name) { return {name}; }

  std::function<void(Server&)> on_hand_over;
  std::function<void(const std::string&)> on_ask;  ///< a session is to be handed over, and a person has come
  directory::ModelStore store_;
  RegistryAgreement agreed_;  ///< of servers that start
  std::vector<std::unique_ptr<Server>> servers_;
  Time now_{};
};

}  // namespace tandem::server::test
