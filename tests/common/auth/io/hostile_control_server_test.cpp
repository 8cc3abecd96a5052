#include <gtest/gtest.h>
#include <sys/eventfd.h>

#include "proto/rpc/rpc_codec.h"
#include "tests/common/auth/io/control_server_fixture.h"
#include "tests/common/auth/io/from_address.h"
#include "tests/common/auth/io/raw_tls.h"
#include "tests/proto/rpc/rpc_samples.h"

/// Hostile peers: too much, too slow, too many, invalid. Deadlines are tested by the order of events, never by a clock.
namespace tandem::server::test {
namespace {

std::string text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::string framed(const rpc::Body& body) { return text(rpc::encode({1, body})->bytes()); }

/// Returns the error code in the bytes that a server sent, if they are a rejection.
std::optional<rpc::ErrorCode> refusal_in(const std::string& bytes) {
  if (bytes.size() <= rpc::kLengthSize) return std::nullopt;
  std::vector<std::byte> frame;
  for (const char c : bytes.substr(rpc::kLengthSize)) frame.push_back(static_cast<std::byte>(c));
  const auto got = rpc::decode(frame);
  const auto* refused = got ? std::get_if<rpc::ErrorReply>(&got->body) : nullptr;
  return refused == nullptr ? std::nullopt : std::optional(refused->code);
}

/// Expects that the control server still serves other clients.
void expect_alive(ControlServerFixture& door) {
  const auto me = door.enrolled("alive");
  auto client = door.connect(me);
  ASSERT_TRUE(client) << client.error().text;
  EXPECT_FALSE(reason_of(client->ask(rpc::SessionListRequest{}, kTimeout)));
}

TEST(ControlServer, RejectsATooLongFrameByItsLengthAlone) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  for (const std::string& length : {std::string("\x01\x20\x00\x00", 4), std::string("\x01\x00\x01\x00", 4),
                                    std::string("\xff\xff\xff\xff"), std::string(4, '\0')}) {
    const RawTls client(door.address, {.identity = &me});
    ASSERT_TRUE(client.handshake);
    ASSERT_TRUE(client.write(length));
    EXPECT_EQ(refusal_in(client.read_to_end()), rpc::ErrorCode::kBadFrame);
  }
  expect_alive(door);
}

TEST(ControlServer, AllowsLongerButBoundedFramesAfterTheFirstReply) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  const RawTls client(door.address, {.identity = &me});
  ASSERT_TRUE(client.write(framed(rpc::SessionListRequest{})));
  const std::string head = client.read(4);
  ASSERT_EQ(head.size(), 4u);
  (void)client.read(static_cast<unsigned char>(head[0]) + 256u * static_cast<unsigned char>(head[1]));
  ASSERT_TRUE(client.write(std::string("\x00\x00\x01\x00", 4) + std::string(65536, 'x')));
  EXPECT_EQ(refusal_in(client.read_to_end()), rpc::ErrorCode::kVersion) << "taken whole, and no frame";
  const RawTls other(door.address, {.identity = &me});
  ASSERT_TRUE(other.write(std::string("\x01\x00\x01\x00", 4)));
  EXPECT_EQ(refusal_in(other.read_to_end()), rpc::ErrorCode::kBadFrame);
}

// A trainee sends a Drain with an invalid payload. Had the server parsed it, it would have reported a bad frame and
// closed the connection.
TEST(ControlServer, RejectsForbiddenFrameBeforeParsing) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  const RawTls client(door.address, {.identity = &me});
  const auto answer = [&] {
    const std::string head = client.read(4);
    if (head.size() < 4) return std::string();
    return head + client.read(static_cast<unsigned char>(head[0]) + 256u * static_cast<unsigned char>(head[1]));
  };
  const auto nonsense = [](rpc::Kind kind) {
    const std::string body = std::string("\x08\x01\x10\x01", 4) +
                             static_cast<char>(static_cast<unsigned>(kind) << 3 | 2) + std::string("\x7f\xff\xff", 3);
    return std::string("\x08\x00\x00\x00", 4) + body;
  };
  ASSERT_TRUE(client.write(framed(hello_with(door.ticket(me)))));
  ASSERT_GT(answer().size(), 100u) << "a welcome";
  for (const auto kind : {rpc::Kind::kDrain, rpc::Kind::kStopSession}) {
    ASSERT_TRUE(client.write(nonsense(kind)));
    EXPECT_EQ(refusal_in(answer()), rpc::ErrorCode::kNotAllowed) << static_cast<int>(kind);
  }
  EXPECT_EQ(door.plane->count(ControlEvent::kBadFrame), 0U);
  EXPECT_EQ(door.plane->count(ControlEvent::kForbidden), 2U);
  ASSERT_TRUE(client.write(nonsense(rpc::Kind::kPauseSession)));  // allowed for a trainee, so the payload is parsed
  EXPECT_EQ(refusal_in(client.read_to_end()), rpc::ErrorCode::kBadFrame);
  expect_alive(door);
}

TEST(ControlServer, ClosesAHandshakeLongerThanAllowed) {
  ControlServerFixture door;
  const RawTcp stranger(door.address);
  // A ClientHello with a declared length of 60000 bytes, in records of 4096.
  std::string bytes;
  for (int i = 0; i < 4; ++i)
    bytes += std::string("\x16\x03\x01\x10\x00", 5) +
             (i == 0 ? std::string("\x01\x00\xea\x60\x03\x03", 6) + std::string(4090, 'r') : std::string(4096, 'r'));
  stranger.send(bytes);
  EXPECT_TRUE(stranger.read_to_end());
  // OpenSSL may reject the ClientHello before it is too long.
  EXPECT_TRUE(door.told(ControlEvent::kTooMuchInput) || door.told(ControlEvent::kHandshakeFailed));
  EXPECT_EQ(door.plane->count(ControlEvent::kTooMuchInput), 1u);
  expect_alive(door);
}

TEST(ControlServer, ClosesASilentConnectionAtTheDeadline) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.deadline = 300ms;
  ControlServerFixture door(limits);
  const auto me = door.enrolled("me");
  const RawTcp nothing(door.address);
  EXPECT_EQ(nothing.read_to_end(), "");
  ASSERT_TRUE(door.told(ControlEvent::kDeadline, 1));
  const RawTcp half_hello(door.address);
  ASSERT_TRUE(half_hello.send(std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc", 9)));
  EXPECT_EQ(half_hello.read_to_end(), "");
  ASSERT_TRUE(door.told(ControlEvent::kDeadline, 2));
}

TEST(ControlServer, ClosesAnIncompleteFrameAtTheDeadline) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.deadline = 2000ms;  // long enough for a handshake, on slow machines too
  limits.frame_deadline = 300ms;
  ControlServerFixture door(limits);
  const auto me = door.enrolled("me");
  {
    const RawTls client(door.address, {.identity = &me});
    ASSERT_TRUE(client.handshake);
    ASSERT_TRUE(client.write(framed(rpc::SessionListRequest{}).substr(0, 5)));
    EXPECT_EQ(client.read_to_end(), "");
    ASSERT_TRUE(door.told(ControlEvent::kDeadline, 1));
  }
  const RawTls client(door.address, {.identity = &me});
  ASSERT_TRUE(client.write(framed(rpc::SessionListRequest{})));
  const std::string head = client.read(4);
  ASSERT_EQ(head.size(), 4u);
  (void)client.read(static_cast<unsigned char>(head[0]) + 256u * static_cast<unsigned char>(head[1]));
  ASSERT_TRUE(client.write(framed(rpc::Ping{1}).substr(0, 2)));
  EXPECT_EQ(client.read_to_end(), "");
  EXPECT_TRUE(door.told(ControlEvent::kDeadline, 2));
}

TEST(ControlServer, BoundsPendingConnectionsAndEvictsTheOldest) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.pending = 4;  // 16 may wait; two of these slots are reserved for returning participants
  ControlServerFixture door(limits);
  std::vector<std::unique_ptr<RawTcp>> silent;
  for (int i = 0; i < 17; ++i) {
    silent.push_back(std::make_unique<RawTcp>(door.address));
    ASSERT_TRUE(silent.back()->connected);
    ASSERT_TRUE(door.told(ControlEvent::kAccepted, i + 1));
  }
  ASSERT_TRUE(door.told(ControlEvent::kEvicted, 3));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(silent[i]->read_to_end(), "") << i;
  EXPECT_EQ(door.plane->count(ControlEvent::kEvicted), 3u);
  silent[5]->close();
  ASSERT_TRUE(door.told(ControlEvent::kHandshakeFailed)) << "and its place is free";
  silent.push_back(std::make_unique<RawTcp>(door.address));
  ASSERT_TRUE(door.told(ControlEvent::kAccepted, 18));
  EXPECT_EQ(door.plane->count(ControlEvent::kEvicted), 3u);
  expect_alive(door);
}

// A client that begins a handshake and stalls keeps a handshake slot until another client needs it.
TEST(ControlServer, BoundsStalledHandshakesAndEvictsTheOldest) {
  ControlLimits limits = ControlServerFixture::patient();
  limits.pending = 4;
  ControlServerFixture door(limits);
  std::vector<std::unique_ptr<RawTcp>> stalled;
  for (int i = 0; i < 6; ++i) {
    stalled.push_back(std::make_unique<RawTcp>(door.address));
    ASSERT_TRUE(stalled.back()->send("\x16"));
    ASSERT_TRUE(door.told(ControlEvent::kAccepted, i + 1));
  }
  ASSERT_TRUE(door.told(ControlEvent::kEvicted, 2));
  expect_alive(door);
}

TEST(ControlServer, RequiresAFirstByteInFiveSecondsOrOneUnderPressure) {
  EXPECT_EQ(ControlLimits{}.first_byte, 5s);
  EXPECT_EQ(ControlLimits{}.first_byte_pressed, 1s);
  ControlLimits limits = ControlServerFixture::patient();
  limits.pending = 4;
  limits.first_byte_pressed = 200ms;
  ControlServerFixture door(limits);
  std::vector<std::unique_ptr<RawTcp>> silent;
  for (int i = 0; i < 8; ++i) silent.push_back(std::make_unique<RawTcp>(door.address));  // half of the 16 slots
  EXPECT_EQ(silent[0]->read_to_end(), "");
  ASSERT_TRUE(door.told(ControlEvent::kDeadline));
  EXPECT_EQ(door.plane->count(ControlEvent::kDeadline), 1u) << "then there is no pressure any more";
}

TEST(ControlServer, Allows256HandshakesAnd1024PendingConnections) {
  EXPECT_EQ(ControlLimits{}.pending, 256u);
  ASSERT_GE(many_descriptors(), 4096u);
  ControlLimits limits = ControlServerFixture::patient();
  limits.accept = {1e6, 1e6, 1e6, 1e6};
  ControlServerFixture door(limits);
  std::vector<std::unique_ptr<RawTcp>> silent;
  for (int i = 0; i < 900; ++i) silent.push_back(std::make_unique<RawTcp>(door.address));
  ASSERT_TRUE(door.told(ControlEvent::kEvicted, 4)) << "an eighth of the 1024 is kept for who comes back";
  ASSERT_TRUE(door.told(ControlEvent::kAccepted, 900));
  EXPECT_EQ(door.plane->count(ControlEvent::kEvicted), 4u);
  for (auto& connection : silent) connection->send("\x16");
  ASSERT_TRUE(door.told(ControlEvent::kEvicted, 4 + 896 - 224)) << "and of the 256 handshakes";
  silent.clear();
  expect_alive(door);
}

TEST(ControlServer, LimitsTheRateOfOneAddress) {
  ControlServerFixture door;
  door.frozen = true;
  std::vector<std::unique_ptr<RawTcp>> many;
  for (int i = 0; i < 110; ++i) many.push_back(std::make_unique<RawTcp>(door.address));
  ASSERT_TRUE(door.told(ControlEvent::kTooFast, 10));
  EXPECT_EQ(door.plane->count(ControlEvent::kAccepted), 100u);
  for (std::size_t i = 100; i < many.size(); ++i) EXPECT_TRUE(many[i]->read_to_end());
}

TEST(ControlServer, AnswersGarbageFramesOnceAndCloses) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  RandomStream random(5);
  for (int i = 0; i < 40; ++i) {
    std::string body(1 + random.below(300), '\0');
    for (char& c : body) c = static_cast<char>(random.bits() & 0xff);
    if (i % 2 == 0) body.replace(0, 2, std::string("\x08\x01", 2));
    const RawTls client(door.address, {.identity = &me});
    ASSERT_TRUE(client.handshake);
    std::string length(4, '\0');
    length[0] = static_cast<char>(body.size() & 0xff);
    length[1] = static_cast<char>(body.size() >> 8);
    ASSERT_TRUE(client.write(length + body));
    const auto reason = refusal_in(client.read_to_end());
    EXPECT_TRUE(reason == rpc::ErrorCode::kBadFrame || reason == rpc::ErrorCode::kVersion) << i;
  }
  expect_alive(door);
}

TEST(ControlServer, RejectsServerMessagesAsRequests) {
  ControlServerFixture door;
  const auto me = door.enrolled("me");
  RandomStream random(6);
  for (const rpc::Kind kind : {rpc::Kind::kWelcome, rpc::Kind::kErrorReply, rpc::Kind::kEnrollAck,
                               rpc::Kind::kSessionList, rpc::Kind::kAuthorityReply, rpc::Kind::kPong, rpc::Kind::kOk}) {
    rpc::Body body = rpc::samples::frame(random, kind).body;
    if (auto* list = std::get_if<rpc::SessionList>(&body))
      list->sessions.resize(std::min<std::size_t>(list->sessions.size(), 1));
    auto client = door.connect(me);
    ASSERT_TRUE(client);
    EXPECT_EQ(reason_of(client->ask(body, kTimeout)), rpc::ErrorCode::kBadFrame) << static_cast<int>(kind);
  }
}

TEST(ControlClient, StopsAtASignalAtOnceAndNamesTheSilentServer) {
  const io::Fd listener{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};  // accepts connections and sends nothing
  auto at = *io::parse_address("127.0.0.1:0", 0);
  ASSERT_EQ(::bind(listener.get(), at.get(), at.size), 0);
  ASSERT_EQ(::listen(listener.get(), 8), 0);
  ASSERT_EQ(::getsockname(listener.get(), reinterpret_cast<sockaddr*>(&at.storage), &at.size), 0);
  const auto me = auth::Identity::make("me", auth::test::counting<16>(), kNow);
  const auto judge = [&](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> {
    return &me;
  };
  const io::Fd signals{::eventfd(1, EFD_CLOEXEC)};  // readable from the start
  const auto interrupted = auth::ControlClient::connect(at, judge, std::chrono::hours(1), signals.get());
  ASSERT_FALSE(interrupted);
  EXPECT_EQ(interrupted.error().kind, auth::ClientError::Kind::kInterrupted);
  const auto silent = auth::ControlClient::connect(at, judge, 100ms, -1);
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error().end, auth::StreamErrorCode::kDeadline);
  EXPECT_NE(silent.error().text.find("no answer in time"), std::string::npos) << silent.error().text;
}

TEST(ControlClient, ReportsThatNoServerListens) {
  io::SocketAddress at;
  {
    ControlServerFixture door;
    at = door.address;
  }
  const auto client = auth::ControlClient::connect(
      at, [](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> { return nullptr; },
      kTimeout, -1);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, auth::ClientError::Kind::kUnreachable);
  EXPECT_NE(client.error().text.find("check that tandem-server runs there"), std::string::npos);
}

}  // namespace
}  // namespace tandem::server::test
