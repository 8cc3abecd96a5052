#include <gtest/gtest.h>

#include "server/service/fenced_writer.h"
#include "tests/io/etcd_process.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using tandem::test::wait_for_reply;

TEST(EtcdWriter, TransactionThatEtcdExecutesAfterALaterOneChangesNothing) {
  if (test::etcd_program("etcd").empty()) GTEST_SKIP() << test::kNoEtcd;
  test::Etcd etcd;
  directory::EtcdOptions options;
  options.endpoints = {etcd.endpoint()};
  directory::EtcdDirectory directory(options);
  directory::OperationId operation = etcd.wait_until_ready(directory);
  const directory::DirectoryKeys names;
  directory.begin(++operation, directory::Transaction{{}, {directory::Put{names.owner("s"), "a"}}, {}});
  const directory::Revision owned = wait_for_reply(directory, operation).revision;

  FencedWriter writer(names, "/writes/a", 1ms);
  Time now{};
  const auto request = [&](const char* value) {
    now += 2s;
    writer.set("s", "/v", value, owned);
    return writer.poll_request(now, ++operation, 1s).value();
  };
  const auto execute = [&](const directory::Request& wanted) {
    directory.begin(operation, wanted);
    const directory::Reply reply = wait_for_reply(directory, operation);
    writer.on_reply(reply);
    return reply.held;
  };
  EXPECT_TRUE(execute(request("runs")));
  EXPECT_TRUE(execute(request("paused"))) << "the revision of the answer is that of the order key";
  const directory::Request late = request("runs again");
  EXPECT_TRUE(execute(request("stopped")));
  ++operation;
  EXPECT_FALSE(execute(late));
  EXPECT_EQ(etcd.etcdctl({"get", "--print-value-only", "/v"}), "stopped\n");

  // Executed before the later one, without an answer to the writer.
  const directory::Request early = request("resumed");
  ++operation;
  EXPECT_TRUE(execute(early));
  EXPECT_FALSE(execute(request("stopped again")));
  EXPECT_EQ(writer.counters().reordered, 1u);
  EXPECT_TRUE(execute(request("stopped again")));
  EXPECT_EQ(etcd.etcdctl({"get", "--print-value-only", "/v"}), "stopped again\n");
}

}  // namespace
}  // namespace tandem::server
