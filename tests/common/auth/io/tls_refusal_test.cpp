#include <gtest/gtest.h>

#include "proto/rpc/rpc_codec.h"
#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/common/auth/io/raw_tls.h"

/// Peers that violate the TLS requirements: rejected, and the server keeps no state about them.
namespace tandem::server::test {
namespace {

/// Expects a rejected handshake: by TLS itself, or before the first byte of an answer. With TLS 1.3 a client considers
/// itself done before the server.
void expect_refused(ControlServerFixture& door, const RawTlsWish& wish, const char* what) {
  const std::uint64_t before = door.plane->count(ControlEvent::kHandshakeFailed);
  const RawTls stranger(door.address, wish);
  if (stranger.handshake) {
    EXPECT_EQ(stranger.read_to_end(), "") << what;
  }
  EXPECT_TRUE(door.told(ControlEvent::kHandshakeFailed, before + 1)) << what;
}

TEST(ControlTls, AcceptsVersion13WithAlpnAndACertificate) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  const RawTls stranger(door.address, {.identity = &me});
  EXPECT_TRUE(stranger.handshake);
  const auto ping = rpc::encode({3, rpc::Ping{5}});
  EXPECT_TRUE(stranger.write({reinterpret_cast<const char*>(ping->bytes().data()), ping->size()}));
  EXPECT_EQ(stranger.read(4).size(), 4u);
}

TEST(ControlTls, RejectsOlderVersions) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  for (const int version : {TLS1_VERSION, TLS1_1_VERSION, TLS1_2_VERSION})
    expect_refused(door, {.version_min = version, .version_max = version, .identity = &me}, "an old version");
}

TEST(ControlTls, RejectsAMissingOrOtherAlpn) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  expect_refused(door, {.alpn = std::nullopt, .identity = &me}, "no ALPN");
  for (const char* other : {"h2", "tandem/2", "tandem/", "Tandem/1", "tandem/11"})
    expect_refused(door, {.alpn = other, .identity = &me}, other);
}

TEST(ControlTls, RejectsOtherCiphersAndKeys) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  expect_refused(door, {.identity = &me, .ciphersuites = "TLS_AES_128_GCM_SHA256"}, "AES-128");
}

TEST(ControlTls, RejectsAMissingCertificateBeforeAnyReply) {
  ControlServerFixture door;
  expect_refused(door, {}, "no certificate");
}

TEST(ControlTls, RejectsPlaintext) {
  ControlServerFixture door;
  for (const std::string& bytes : {std::string("GET / HTTP/1.1\r\n\r\n"), std::string(4, '\0') + std::string(64, 'x'),
                                   std::string("\x12\x00\x00\x00\x08\x01", 6)}) {
    const std::uint64_t before = door.plane->count(ControlEvent::kHandshakeFailed);
    const RawTcp stranger(door.address);
    ASSERT_TRUE(stranger.connected);
    EXPECT_TRUE(stranger.send(bytes));
    ASSERT_TRUE(bytes.size() > 8 || ::shutdown(stranger.get(), SHUT_WR) == 0);
    const auto answer = stranger.read_to_end();
    ASSERT_TRUE(answer) << "the server must end it";
    EXPECT_LE(answer->size(), 7u) << "at most TLS's own alert";
    EXPECT_TRUE(door.told(ControlEvent::kHandshakeFailed, before + 1));
  }
}

TEST(ControlTls, RejectsAnotherServerKeyBeforeSendingData) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  bool asked = false;
  const auto client = auth::ControlClient::connect(
      door.address,
      [&](const auth::KeyFingerprint& fingerprint) -> std::expected<const auth::Identity*, std::string> {
        asked = true;
        EXPECT_EQ(fingerprint, door.server_fingerprint);
        return std::unexpected("this is not the expected key");
      },
      kTimeout, -1);
  ASSERT_FALSE(client);
  EXPECT_TRUE(asked);
  EXPECT_EQ(client.error().kind, auth::ClientError::Kind::kRefusedKey);
  EXPECT_EQ(client.error().text, "this is not the expected key");
  ASSERT_TRUE(door.told(ControlEvent::kHandshakeFailed));
  // The server read and looked up nothing: the handshake did not reach the client's certificate.
  for (const ControlEventRecord& news : door.news())
    EXPECT_TRUE(news.event == ControlEvent::kAccepted || news.event == ControlEvent::kHandshakeFailed);
}

TEST(ControlTls, RejectsAServerWithAnotherProtocol) {
  // A TLS server with the right key, but without our ALPN.
  const auto key = auth::Identity::make("server", auth::test::counting<16>(), kNow);
  asio::io_context context;
  asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
  asio::ssl::context tls(asio::ssl::context::tlsv13_server);
  SSL_CTX_use_certificate(tls.native_handle(), key.certificate.handle());
  SSL_CTX_use_PrivateKey(tls.native_handle(), key.key.handle());
  std::thread other([&] {
    asio::error_code error;
    asio::ssl::stream<asio::ip::tcp::socket> stream(acceptor.accept(), tls);
    stream.handshake(asio::ssl::stream_base::server, error);
    char any = 0;
    stream.read_some(asio::buffer(&any, 1), error);
  });
  const auto at = io::parse_address("127.0.0.1:" + std::to_string(acceptor.local_endpoint().port()), 1);
  const auto client = auth::ControlClient::connect(
      *at, [&](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> { return &key; },
      kTimeout, -1);
  ASSERT_FALSE(client);
  EXPECT_NE(client.error().text.find("tandem/1"), std::string::npos) << client.error().text;
  other.join();
}

TEST(ControlTls, GivesBothEndsTheSameSecretsAndOthersForAnotherContext) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client) << client.error().text;
  const auto answer = client->ask(hello_with(door.ticket(me)), kTimeout);
  ASSERT_TRUE(answer) << answer.error().text;
  const auto* welcome = std::get_if<rpc::Welcome>(&*answer);
  ASSERT_NE(welcome, nullptr);
  const auth::ExporterContext context{welcome->session_id, welcome->epoch, welcome->server_cid, welcome->role,
                                      welcome->seat};
  const auto mine = client->export_secrets(context);
  ASSERT_TRUE(mine);
  {
    const std::lock_guard lock(door.sessions->mutex);
    EXPECT_EQ(door.sessions->seats_secrets.at("trainee"), mine->bytes);
  }
  auto raised = context;
  raised.role = AccessRole::kInstructor;
  EXPECT_NE(client->export_secrets(raised)->bytes, mine->bytes);
  auto second = door.connect(me);
  ASSERT_TRUE(second);
  EXPECT_NE(second->export_secrets(context)->bytes, mine->bytes) << "another connection";
}

}  // namespace
}  // namespace tandem::server::test
