// Members of etcd that answer as a full one does, or not at all. No etcd is needed.
#include <etcd.grpc.pb.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <memory>
#include <string>

#include "common/base/format.h"
#include "common/io/fd.h"
#include "server/directory/io/etcd_directory.h"
#include "tests/io/etcd_process.h"

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;
using tandem::test::wait_for_reply;

EtcdOptions to(std::vector<std::string> endpoints) {
  EtcdOptions options;
  options.endpoints = std::move(endpoints);
  options.answer_limit = 60s;
  return options;
}

/// At its quota: it renews leases, and stores nothing.
class FullMember {
 public:
  FullMember() {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(&store_);
    builder.RegisterService(&leases_);
    server_ = builder.BuildAndStart();
  }
  [[nodiscard]] std::string endpoint() const { return format("127.0.0.1:%d", port_); }

 private:
  struct Store final : etcdserverpb::KV::Service {
    grpc::Status Txn(grpc::ServerContext*, const etcdserverpb::TxnRequest*, etcdserverpb::TxnResponse*) override {
      return {grpc::StatusCode::RESOURCE_EXHAUSTED, "etcdserver: mvcc: database space exceeded"};
    }
  } store_;
  struct Leases final : etcdserverpb::Lease::Service {
    grpc::Status LeaseKeepAlive(grpc::ServerContext*,
                                grpc::ServerReaderWriter<etcdserverpb::LeaseKeepAliveResponse,
                                                         etcdserverpb::LeaseKeepAliveRequest>* stream) override {
      etcdserverpb::LeaseKeepAliveRequest wanted;
      etcdserverpb::LeaseKeepAliveResponse answer;
      answer.set_ttl(3);
      while (stream->Read(&wanted)) stream->Write(answer);
      return grpc::Status::OK;
    }
  } leases_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

// The other member is gone, so a renewal that went there would fail.
TEST(EtcdAnswers, ServerStaysAtAMemberThatIsFull) {
  FullMember member;
  EtcdDirectory directory(to({member.endpoint(), "127.0.0.1:1"}));
  for (OperationId n = 1; n <= 6; n += 2) {
    directory.begin(n, Transaction{{}, {Put{"key", "value"}}, {}});
    const Reply reply = wait_for_reply(directory, n);
    EXPECT_EQ(reply.outcome, Outcome::kUnknown);
    EXPECT_EQ(reply.reason, "etcdserver: mvcc: database space exceeded");
    directory.begin(n + 1, Renew{1});
    EXPECT_EQ(wait_for_reply(directory, n + 1).outcome, Outcome::kDone);
  }
  EXPECT_EQ(directory.counters().endpoint_changes, 0U);
}

TEST(EtcdAnswers, OpenRequestsLeaveRoomForThoseThatKeepALease) {
  // It accepts connections and never answers.
  const io::Fd silent(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof at;
  ASSERT_EQ(::bind(silent.get(), reinterpret_cast<const sockaddr*>(&at), size), 0);
  ASSERT_EQ(::listen(silent.get(), 8), 0);
  ASSERT_EQ(::getsockname(silent.get(), reinterpret_cast<sockaddr*>(&at), &size), 0);
  EtcdDirectory directory(to({format("127.0.0.1:%d", ntohs(at.sin_port))}));
  OperationId n = 0;
  const auto refused = [&](const Request& request) {
    const auto before = directory.counters().overflowed;
    directory.begin(++n, request);
    return directory.counters().overflowed > before;
  };
  const Transaction put{{}, {Put{"key", "value"}}, {}}, read{{}, {Read{"key"}}, {}};
  while (n < EtcdDirectory::kOpenMax) static_cast<void>(refused(put));
  EXPECT_GT(directory.counters().overflowed, 0U);
  for (std::size_t taken = 0; taken + 4 < EtcdDirectory::kReserved; taken += 3)
    EXPECT_FALSE(refused(Grant{3s}) || refused(Renew{1}) || refused(read)) << taken;
  for (std::size_t more = 0; more < EtcdDirectory::kReserved; ++more) static_cast<void>(refused(Renew{1}));
  EXPECT_TRUE(refused(Renew{1})) << "these are bounded too";
}

}  // namespace
}  // namespace tandem::directory
