#include <gtest/gtest.h>

#include "proto/control_codec.h"
#include "tests/trust/io/door.h"
#include "tests/trust/io/raw_tls.h"

/// Who does not speak as agreed: refused, and nothing of him is kept.
namespace tandem::server::test {
namespace {

/// Handshake refused: by TLS itself, or (with TLS 1.3 a client believes itself done first) before a byte of an answer.
void expect_refused(Door& door, const RawTlsWish& wish, const char* what) {
  const std::uint64_t before = door.plane->count(ControlEvent::kHandshakeFailed);
  const RawTls stranger(door.address, wish);
  if (stranger.handshake) {
    EXPECT_EQ(stranger.read_to_end(), "") << what;
  }
  EXPECT_TRUE(door.told(ControlEvent::kHandshakeFailed, before + 1)) << what;
}

TEST(ControlTls, TakesVersion13WithAlpnAndACertificate) {
  Door door;
  const auto me = door.enrolled("me");
  const RawTls stranger(door.address, {.identity = &me});
  EXPECT_TRUE(stranger.handshake);
  const auto ping = control::encode({3, control::Ping{5}});
  EXPECT_TRUE(stranger.write({reinterpret_cast<const char*>(ping->bytes().data()), ping->size()}));
  EXPECT_EQ(stranger.read(4).size(), 4u);
}

TEST(ControlTls, OlderVersionsAreRefused) {
  Door door;
  const auto me = door.enrolled("me");
  for (const int version : {TLS1_VERSION, TLS1_1_VERSION, TLS1_2_VERSION})
    expect_refused(door, {.version_min = version, .version_max = version, .identity = &me}, "an old version");
}

TEST(ControlTls, NoOrAnotherAlpnIsRefused) {
  Door door;
  const auto me = door.enrolled("me");
  expect_refused(door, {.alpn = std::nullopt, .identity = &me}, "no ALPN");
  for (const char* other : {"h2", "tandem/2", "tandem/", "Tandem/1", "tandem/11"}) expect_refused(door, {.alpn = other, .identity = &me}, other);
}

TEST(ControlTls, OtherCiphersAndKeysAreRefused) {
  Door door;
  const auto me = door.enrolled("me");
  expect_refused(door, {.identity = &me, .ciphersuites = "TLS_AES_128_GCM_SHA256"}, "AES-128");
}

TEST(ControlTls, NoCertificateIsRefusedBeforeAnyAnswer) {
  Door door;
  expect_refused(door, {}, "no certificate");
}

TEST(ControlTls, PlaintextIsRefused) {
  Door door;
  for (const std::string& bytes :
       {std::string("GET / HTTP/1.1\r\n\r\n"), std::string(4, '\0') + std::string(64, 'x'), std::string("\x12\x00\x00\x00\x08\x01", 6)}) {
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

TEST(ControlTls, TheClientRefusesAnotherServerKeyBeforeItSendsAnythingOfValue) {
  Door door;
  const auto me = door.enrolled("me");
  bool asked = false;
  const auto client = trust::ControlClient::connect(
      door.address,
      [&](const trust::Pin& pin) -> std::expected<const trust::Identity*, std::string> {
        asked = true;
        EXPECT_EQ(pin, door.server_pin);
        return std::unexpected("this is not the key I was told");
      },
      kPatience, -1);
  ASSERT_FALSE(client);
  EXPECT_TRUE(asked);
  EXPECT_EQ(client.error().kind, trust::ClientFault::Kind::kRefusedKey);
  EXPECT_EQ(client.error().text, "this is not the key I was told");
  ASSERT_TRUE(door.told(ControlEvent::kHandshakeFailed));
  // Nobody was looked up, nothing was read: the handshake never got as far as the client's certificate.
  for (const ControlNews& news : door.news()) EXPECT_TRUE(news.event == ControlEvent::kAccepted || news.event == ControlEvent::kHandshakeFailed);
}

TEST(ControlTls, TheClientRefusesAServerThatSpeaksAnotherProtocol) {
  // A TLS server with the right key, but without our ALPN.
  const auto key = trust::Identity::make("server", trust::test::counting<16>(), kNow);
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
  const auto client = trust::ControlClient::connect(
      *at, [&](const trust::Pin&) -> std::expected<const trust::Identity*, std::string> { return &key; }, kPatience, -1);
  ASSERT_FALSE(client);
  EXPECT_NE(client.error().text.find("tandem/1"), std::string::npos) << client.error().text;
  other.join();
}

TEST(ControlTls, GivesBothEndsTheSameSecretsAndOthersForAnotherContext) {
  Door door;
  const auto me = door.enrolled("me");
  auto client = door.connect(me);
  ASSERT_TRUE(client) << client.error().text;
  const auto answer = client->ask(hello_with(door.ticket(me)), kPatience);
  ASSERT_TRUE(answer) << answer.error().text;
  const auto* welcome = std::get_if<control::Welcome>(&*answer);
  ASSERT_NE(welcome, nullptr);
  const trust::LinkContext context{welcome->session_id, welcome->epoch, welcome->server_cid, welcome->role, welcome->seat};
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
