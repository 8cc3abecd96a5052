// Answers to /metrics, /healthz and /readyz by the state of the server and of its service.
#include "server/app/monitor/metrics.h"

#include <gtest/gtest.h>

#include "tests/server/app/monitor/idle_server.h"

namespace tandem::server {
namespace {

using namespace test;

/// @return the reason for 503; empty: the server is ready
std::string not_ready(const IdleServer& server, const ServiceStatus& service) {
  const HttpResponse health = server.page("/healthz", &service);
  EXPECT_EQ(health.status, 200) << "no restart of the server helps: " << health.body;
  const HttpResponse ready = server.page("/readyz", &service);
  EXPECT_EQ(ready.status, ready.body == "ok\n" ? 200 : 503) << ready.body;
  return ready.status == 200 ? "" : ready.body;
}

TEST(MonitoringPage, IsReadyAloneAndAsAMemberWhoseDirectoryAnswers) {
  const IdleServer server;
  EXPECT_EQ(server.page("/readyz", nullptr).status, 200);
  EXPECT_EQ(not_ready(server, status_of_member()), "");
  ServiceStatus standby = status_of_member();
  standby.owned = 0;
  EXPECT_EQ(not_ready(server, standby), "");
}

TEST(MonitoringPage, IsNotReadyWithoutAnswerOfTheDirectory) {
  const IdleServer server;
  ServiceStatus cut = status_of_member();
  cut.answers = false;
  EXPECT_EQ(not_ready(server, cut), "the directory of the service does not answer\n");
  cut.holding = true;
  EXPECT_EQ(not_ready(server, cut), "the directory of the service does not answer, and the sessions are HELD\n");
  EXPECT_EQ(not_ready(server, ServiceStatus{}), "the directory of the service does not answer\n")
      << "a server without a session, from its start on";
}

TEST(MonitoringPage, IsNotReadyUntilItIsRegistered) {
  const IdleServer server;
  ServiceStatus status = status_of_member();
  status.registered = false;
  EXPECT_EQ(not_ready(server, status), "this server is not registered in its service\n");
  status.name_taken = true;
  EXPECT_EQ(not_ready(server, status), "another server is registered in the service under the name of this one\n");
}

TEST(MonitoringPage, IsNotReadyWhileItsSessionsAreHeld) {
  const IdleServer server;
  ServiceStatus status = status_of_member();
  status.holding = true;
  EXPECT_EQ(not_ready(server, status), "the sessions are HELD: the lease of this server was not renewed in time\n");
  EXPECT_NE(server.page("/metrics", &status).body.find("\ntandem_service_held 1\n"), std::string::npos);
  status.owned = 0;
  EXPECT_EQ(not_ready(server, status), "") << "no session is HELD";
  EXPECT_NE(server.page("/metrics", &status).body.find("\ntandem_service_held 0\n"), std::string::npos);
}

TEST(MonitoringPage, ShowsTheEndOfTheVoucherToTheSecond) {
  const ServiceStatus status = status_of_member();
  EXPECT_NE(IdleServer{}.page("/metrics", &status).body.find("\ntandem_service_voucher_expiry_seconds 1798761599\n"),
            std::string::npos);
}

TEST(MonitoringPage, NamesTheOldReasonsFirst) {
  IdleServer server;
  server.audit.trouble = "No space left on device";
  EXPECT_EQ(not_ready(server, ServiceStatus{}), "the audit log fails; the server's own log has the cause\n");
  server.registry.drain().begin();
  EXPECT_EQ(not_ready(server, ServiceStatus{}), "draining\n");
}

}  // namespace
}  // namespace tandem::server
