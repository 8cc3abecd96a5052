#include "proto/rpc/older_peers.h"

#include <gtest/gtest.h>

#include "proto/rpc/rpc_codec.h"
#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/common/auth/io/raw_tls.h"

/// Clients and servers of before the phase "held" of a session, which reject frames with a phase that they do not know.
namespace tandem::server::test {
namespace {

using rpc::SessionPhase;

/// Asks as a client that offers `protocol` only. @return the first session of the list
rpc::ListedSession first_listed(const ControlServerFixture& door, const auth::Identity& me, const char* protocol) {
  const RawTls client(door.address, {.alpn = protocol, .identity = &me});
  const auto request = rpc::encode({3, rpc::SessionListRequest{}});
  EXPECT_TRUE(client.write({reinterpret_cast<const char*>(request->bytes().data()), request->size()}));
  const std::string head = client.read(4);
  if (head.size() < 4) return {};
  const std::string body =
      client.read(static_cast<unsigned char>(head[0]) + 256U * static_cast<unsigned char>(head[1]));
  const auto reply = rpc::decode(std::as_bytes(std::span(body)));
  return reply ? std::get<rpc::SessionList>(reply->body).sessions.at(0) : rpc::ListedSession{};
}

TEST(OlderPeers, GetASessionThatIsHeldAsRunning) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  door.sessions->phase = SessionPhase::kHeld;
  EXPECT_EQ(first_listed(door, me, "tandem/1").phase, SessionPhase::kRunning);
  EXPECT_EQ(first_listed(door, me, "tandem/1.1").phase, SessionPhase::kHeld);
  auto client = door.connect(me);
  ASSERT_TRUE(client) << client.error().text;
  const auto list = client->ask(rpc::SessionListRequest{}, kTimeout);
  ASSERT_TRUE(list) << list.error().text;
  EXPECT_EQ(std::get<rpc::SessionList>(*list).sessions.at(0).phase, SessionPhase::kHeld);
}

TEST(OlderPeers, GetNoPhaseInAnyReplyThatTheyDoNotKnow) {
  rpc::SessionList list;
  for (std::size_t i = 0; i < rpc::kSessionPhases; ++i)
    list.sessions.push_back({{}, "a", static_cast<SessionPhase>(i), {}});
  rpc::Status status;
  rpc::SessionCreated created;
  status.phase = created.session.phase = SessionPhase::kHeld;
  status.counts = rpc::StatusCounts{1, 2, 3};
  status.not_stored = "the disk is full";
  for (rpc::Body reply : {rpc::Body(list), rpc::Body(status), rpc::Body(created)}) {
    rpc::write_for_older_peer(reply);
    if (const auto* written = std::get_if<rpc::Status>(&reply)) {
      EXPECT_EQ(written->phase, SessionPhase::kRunning);
      EXPECT_EQ(written->counts, std::nullopt);
      EXPECT_EQ(written->not_stored, "");
    }
    if (const auto* written = std::get_if<rpc::SessionCreated>(&reply)) {
      EXPECT_EQ(written->session.phase, SessionPhase::kRunning);
    }
    const auto* const written = std::get_if<rpc::SessionList>(&reply);
    for (std::size_t i = 0; written != nullptr && i < rpc::kSessionPhases; ++i) {
      const bool held = list.sessions[i].phase == SessionPhase::kHeld;
      EXPECT_EQ(written->sessions[i].phase, held ? SessionPhase::kRunning : list.sessions[i].phase) << i;
    }
  }
}

TEST(OlderPeers, GetAnErrorForAnOrderThatIsNotStored) {
  rpc::Body stored = rpc::Ok{}, not_stored = rpc::Ok{"the session is STOPPED, but this is not stored yet"};
  rpc::write_for_older_peer(stored);
  EXPECT_EQ(stored, rpc::Body(rpc::Ok{}));
  rpc::write_for_older_peer(not_stored);
  const auto* const error = std::get_if<rpc::ErrorReply>(&not_stored);
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->text, "the session is STOPPED, but this is not stored yet");
}

/// A server that knows `tandem/1` only searches the client's list for it.
int choose_as_older_server(SSL*, const unsigned char** out, unsigned char* size, const unsigned char* in,
                           unsigned int in_size, void*) {
  constexpr std::string_view kWanted = "\x08tandem/1";
  for (unsigned int at = 0; at < in_size; at += in[at] + 1U) {
    if (at + kWanted.size() > in_size || std::memcmp(in + at, kWanted.data(), kWanted.size()) != 0) continue;
    *out = in + at + 1;
    *size = in[at];
    return SSL_TLSEXT_ERR_OK;
  }
  return SSL_TLSEXT_ERR_ALERT_FATAL;
}

TEST(OlderPeers, MayBeServers) {
  const auto key = auth::Identity::make("server", auth::test::counting<16>(), kNow);
  asio::io_context context;
  asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
  asio::ssl::context tls(asio::ssl::context::tlsv13_server);
  SSL_CTX_use_certificate(tls.native_handle(), key.certificate.handle());
  SSL_CTX_use_PrivateKey(tls.native_handle(), key.key.handle());
  SSL_CTX_set_alpn_select_cb(tls.native_handle(), &choose_as_older_server, nullptr);
  std::thread other([&] {
    asio::error_code error;
    asio::ssl::stream<asio::ip::tcp::socket> stream(acceptor.accept(), tls);
    stream.handshake(asio::ssl::stream_base::server, error);
    char any = 0;
    stream.read_some(asio::buffer(&any, 1), error);
  });
  const auto at = io::parse_address("127.0.0.1:" + std::to_string(acceptor.local_endpoint().port()), 1);
  {
    const auto client = auth::ControlClient::connect(
        *at, [&](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> { return &key; },
        kTimeout, -1);
    EXPECT_TRUE(client) << client.error().text;
  }
  other.join();
}

}  // namespace
}  // namespace tandem::server::test
