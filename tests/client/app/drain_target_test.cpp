#include "client/app/drain_target.h"

#include <gtest/gtest.h>

#include "client/app/server_addresses.h"

namespace tandem::client {
namespace {

JoinOptions asked(const std::string& servers) {
  JoinOptions options;
  EXPECT_EQ(set_server_addresses(servers, options), "");
  return options;
}
const DrainTarget kAlone{"", "127.0.0.1:7000"}, kOwner{"a", "127.0.0.1:7001", true, {"127.0.0.1:7002"}},
    kLast{"a", "127.0.0.1:7001", true};

TEST(DrainTarget, ConfirmationNamesTheServerAndWhereItsSessionsGo) {
  EXPECT_EQ(drain_text(kAlone, 20),
            "the server at 127.0.0.1:7000 is draining: new joins are rejected; all hands are released in 20 s, then it "
            "ends");
  EXPECT_EQ(drain_text(kOwner, 20),
            "server a at 127.0.0.1:7001 is draining: new joins are rejected; its sessions move to other servers of the "
            "service, and it ends when it has none; of those that find no room all hands are released in 20 s, then it "
            "ends");
  EXPECT_EQ(drain_text(kOwner, 0),
            "server a at 127.0.0.1:7001 is draining: new joins are rejected; all hands are released, then it ends; "
            "other servers of the service take its sessions over");
  EXPECT_EQ(drain_text(kLast, 0),
            "server a at 127.0.0.1:7001 is draining: new joins are rejected; all hands are released, then it ends");
}

TEST(DrainTarget, IsTheServerThatTheUserNamed) {
  EXPECT_EQ(drain_problem(asked("127.0.0.1:7000"), kAlone, "lab"), "");
  EXPECT_EQ(drain_problem(asked("127.0.0.1:7001"), kOwner, "lab"), "");
  EXPECT_EQ(drain_problem(asked("127.0.0.1:6999,127.0.0.1:7000"), kAlone, "lab"), "") << "two addresses of one server";
}

TEST(DrainTarget, RefusalNamesBothServersAndTheRemedy) {
  EXPECT_EQ(drain_problem(asked("127.0.0.1:7002"), kOwner, "lab"),
            "drain: --server names 127.0.0.1:7002, but session lab is served by server a at 127.0.0.1:7001, and a "
            "drain ends the server that serves the session of its console. To end that one, give --server "
            "127.0.0.1:7001; to end the one at 127.0.0.1:7002, use `tandem-server stop` on its computer");
}

TEST(DrainTarget, RefusalAsksForOneOfSeveralServers) {
  const std::string both = "127.0.0.1:7001,127.0.0.1:7002";
  const std::string begin = "drain: --server names several servers of a service, " + both +
                            ", and a drain ends one of them. Name only the one that is to end; it must serve the "
                            "session of the ticket",
                    end = ". To end another one, use `tandem-server stop` on its computer";
  EXPECT_EQ(drain_problem(asked(both), kOwner, ""), begin + end);
  EXPECT_EQ(drain_problem(asked(both), kOwner, "lab"),
            begin + ", as server a at 127.0.0.1:7001 serves session lab" + end);
}

TEST(DrainTarget, RefusalAsksForOneServerWhereANameHasTheAddressesOfSeveral) {
  JoinOptions name = asked("127.0.0.1:7002,127.0.0.1:7001");
  name.typed = {"service.example:7000"};
  EXPECT_EQ(drain_problem(name, kOwner, "lab").find("drain: --server names several servers of a service, service.exa"),
            0u);
  EXPECT_EQ(drain_problem(name, kLast, "lab"), "") << "two addresses of one server";
}

}  // namespace
}  // namespace tandem::client
