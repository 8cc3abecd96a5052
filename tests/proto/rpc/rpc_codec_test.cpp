#include "proto/rpc/rpc_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "common/base/hex.h"
#include "tests/common/base/counts.h"
#include "tests/proto/rpc/rpc_samples.h"

namespace tandem::rpc {
namespace {

using Bytes = std::vector<std::byte>;

Bytes body_of(const Frame& frame) {
  const auto out = encode(frame);
  EXPECT_TRUE(out);
  if (!out) return {};
  return {out->bytes().begin() + kLengthSize, out->bytes().end()};
}
Bytes bytes(std::initializer_list<unsigned> values) {
  Bytes out;
  for (const unsigned v : values) out.push_back(static_cast<std::byte>(v));
  return out;
}

TEST(RpcCodec, RoundTripsEveryMessage) {
  RandomStream random(1);
  const std::uint64_t count = tandem::test::seeds(3000);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Frame frame = samples::frame(random, samples::kind(i));
    const auto out = encode(frame);
    ASSERT_TRUE(out) << i;
    const auto all = out->bytes();
    const auto length = frame_length(all.first<kLengthSize>());
    ASSERT_TRUE(length);
    ASSERT_EQ(*length + kLengthSize, all.size());
    const auto body = all.subspan(kLengthSize);
    EXPECT_EQ(peek(body), (Head{kind_of(frame), frame.request}));
    const auto got = decode(body);
    ASSERT_TRUE(got) << i << ": " << to_text(got.error());
    EXPECT_EQ(*got, frame);
  }
}

TEST(RpcCodec, EncodesAPingToKnownBytes) {
  // length 15; version 1; request 7; field 16, 9 bytes; fixed64 field 1 = 0x0807060504030201
  const auto out = encode({7, Ping{0x0807060504030201}});
  ASSERT_TRUE(out);
  EXPECT_EQ(Bytes(out->bytes().begin(), out->bytes().end()),
            bytes({16, 0, 0, 0, 0x08, 1, 0x10, 7, 0x82, 1, 9, 9, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(RpcCodec, TheLargestListFitsAFrame) {
  SessionList list;
  for (std::size_t i = 0; i < kListedSessionsMax; ++i) {
    ListedSession& s = list.sessions.emplace_back();
    s.name = std::string(kNameMax, 'n');
    s.phase = SessionPhase::kEnding;
    for (std::size_t k = 0; k < kListedSeatsMax; ++k)
      s.seats.push_back({std::string(kNameMax, 's'), AccessRole::kRecorder, true, true});
  }
  list.more = true;
  list.last = 0xffffffff;
  EXPECT_TRUE(encode({0xffffffff, list}));
  list.sessions.emplace_back(list.sessions.front());
  EXPECT_FALSE(encode({0, list}));
}

TEST(RpcCodec, BoundsLengths) {
  const auto length = [](std::uint32_t n, std::size_t limit = kFrameMax) {
    std::array<std::byte, 4> head;
    for (std::size_t i = 0; i < 4; ++i) head[i] = static_cast<std::byte>(n >> (8 * i) & 0xff);
    return frame_length(head, limit);
  };
  EXPECT_EQ(length(1), 1u);
  EXPECT_EQ(length(65536), 65536u);
  for (const std::uint32_t bad : {0u, 65537u, 0x80000000u, 0xffffffffu})
    EXPECT_EQ(length(bad), std::unexpected(FrameError::kLength));
  EXPECT_EQ(length(8192, 8192), 8192u);
  EXPECT_FALSE(length(8193, 8192));
  EXPECT_FALSE(length(65537, 1 << 20));
  EXPECT_EQ(decode(Bytes(kFrameMax + 1)).error(), FrameError::kLength);
  EXPECT_EQ(decode({}).error(), FrameError::kLength);
}

TEST(RpcCodec, ReportsAnotherVersionBeforeParsing) {
  Bytes body = body_of({1, Ping{5}});
  for (const unsigned version : {0u, 2u, 127u}) {
    body[1] = static_cast<std::byte>(version);
    EXPECT_EQ(decode(body).error(), FrameError::kVersion);
  }
  EXPECT_EQ(decode(bytes({0x08, 2, 0xff, 0xff, 0xff})).error(), FrameError::kVersion);
  EXPECT_EQ(decode(bytes({0x10, 1})).error(), FrameError::kVersion) << "the version comes first";
}

TEST(RpcCodec, AcceptsOnlyOneEncodingPerMessage) {
  const Bytes ping = body_of({7, Ping{1}});
  ASSERT_TRUE(decode(ping));
  const auto with = [&](std::size_t at, const Bytes& more) {
    Bytes out = ping;
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(at), more.begin(), more.end());
    return out;
  };
  EXPECT_EQ(decode(with(ping.size(), bytes({0x98, 6, 1}))).error(), FrameError::kMalformed) << "unknown field 99";
  EXPECT_EQ(decode(with(ping.size(), bytes({0x82, 1, 9, 9, 1, 0, 0, 0, 0, 0, 0, 0}))).error(), FrameError::kMalformed)
      << "the body twice";
  EXPECT_EQ(decode(with(2, bytes({0x10, 7}))).error(), FrameError::kMalformed) << "the request twice";
  Bytes zero_request = body_of({0, Ping{1}});
  ASSERT_TRUE(decode(zero_request));
  zero_request.insert(zero_request.begin() + 2, {std::byte{0x10}, std::byte{0}});
  EXPECT_EQ(decode(zero_request).error(), FrameError::kMalformed) << "a default written out";
  Bytes long_varint = ping;
  long_varint[3] = std::byte{0x87};
  long_varint.insert(long_varint.begin() + 4, std::byte{0});
  EXPECT_EQ(decode(long_varint).error(), FrameError::kMalformed) << "a number in a second form";
  EXPECT_EQ(decode(bytes({0x08, 1})).error(), FrameError::kMalformed) << "no message";
  EXPECT_EQ(decode(bytes({0x08, 1, 0x10, 7})).error(), FrameError::kMalformed);
  EXPECT_EQ(decode(bytes({0x08, 1, 0x82, 2, 0})).error(), FrameError::kMalformed) << "field 32 does not exist";
  EXPECT_EQ(decode(bytes({0x08, 1, 0x1b, 0x1c})).error(), FrameError::kMalformed) << "groups";
}

TEST(RpcCodec, RejectsOutOfRangeFieldsInBothDirections) {
  RandomStream random(4);
  const auto refuses = [](const Body& body) {
    const auto out = encode({1, body});
    return !out && out.error() == FrameError::kOutOfRange;
  };
  const auto hello = [&](auto change) {
    Hello m;
    m.seat = "a";
    change(m);
    return refuses(m);
  };
  EXPECT_FALSE(hello([](Hello&) {}));
  EXPECT_TRUE(hello([](Hello& m) { m.versions = {}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.versions = {2, 1}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.versions = {1, 1}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.versions = {0}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.versions = {65536}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.versions = {1, 2, 3, 4, 5, 6, 7, 8, 9}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.seat = std::string(33, 'a'); }));
  EXPECT_TRUE(hello([](Hello& m) { m.seat = "a/b"; }));
  EXPECT_TRUE(hello([](Hello& m) { m.seat = "trainer", m.watch = true; })) << "a seat does not watch";
  EXPECT_TRUE(hello([](Hello& m) { m.seat = "", m.link_test = m.watch = true; })) << "nor does a link test";
  EXPECT_FALSE(hello([](Hello& m) { m.seat = "", m.watch = true; }));
  EXPECT_TRUE(hello([](Hello& m) { m.session = std::string("short"); }));
  EXPECT_TRUE(hello([](Hello& m) { m.session = std::string("abcde12345"); }));
  EXPECT_TRUE(hello([](Hello& m) { m.credential = TicketCredential{}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.credential = TicketCredential{Bytes(kTicketMax + 1)}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.credential = CodeCredential{"12345"}; }));
  EXPECT_TRUE(hello([](Hello& m) { m.device.joints = 0; }));
  EXPECT_TRUE(hello([](Hello& m) { m.device.tip_axes = kAxesMax + 1; }));
  for (const double bad : {-1.0, 1.1e4, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_TRUE(hello([bad](Hello& m) { m.device.mass_kg = bad; }));
  for (const double bad : {-0.001, 1.1, std::nan("")})
    EXPECT_TRUE(hello([bad](Hello& m) { m.device.latency_s = bad; }));
  const auto welcome = [&](auto change) {
    Welcome m = samples::welcome(random);
    change(m);
    return refuses(m);
  };
  EXPECT_TRUE(welcome([](Welcome& m) { m.session_name = ""; }));
  EXPECT_TRUE(welcome([](Welcome& m) { m.udp_port = 0; }));
  EXPECT_TRUE(welcome([](Welcome& m) { m.setup.resize(wire::kSetupMax + 1); }));
  EXPECT_TRUE(welcome([](Welcome& m) { m.role = static_cast<AccessRole>(6); }));
  EXPECT_TRUE(welcome([](Welcome& m) { m.limits.commands_burst = 0; }));
  EXPECT_TRUE(welcome([](Welcome& m) { m.version = 0; }));
  EXPECT_TRUE(refuses(ErrorReply{static_cast<ErrorCode>(0), "", 0}));
  EXPECT_TRUE(refuses(ErrorReply{static_cast<ErrorCode>(kErrorCodes + 1), "", 0}));
  EXPECT_TRUE(refuses(ErrorReply{ErrorCode::kFull, "", 86401}));
  EXPECT_TRUE(refuses(EnrollAck{""}));
  EXPECT_TRUE(refuses(Drain{3601}));
  for (const std::vector<double>& bad :
       {std::vector<double>{}, {0.5}, {0.5, 0.6}, {-0.5, 1.5}, {std::nan(""), 1}, std::vector<double>(17, 1.0 / 17)})
    EXPECT_TRUE(refuses(SetAuthority{{}, 0, 0, bad}));
  EXPECT_TRUE(refuses(SetAuthority{{}, kToolsMax, 0, {1.0}}));
  EXPECT_TRUE(refuses(RemoveParticipant{{}, "", ""}));
  EXPECT_TRUE(refuses(RemoveParticipant{{}, "trainee", "a\nb"}));
  EXPECT_FALSE(refuses(RemoveParticipant{{}, "trainee", "pushes the others"}));
  const auto status = [&](auto change) {
    Status m;
    m.name = "a";
    change(m);
    return refuses(m);
  };
  EXPECT_FALSE(status([](Status&) {}));
  EXPECT_TRUE(status([](Status& m) { m.name = ""; }));
  for (const double bad : {-1.0, 1.1e9, std::nan("")}) EXPECT_TRUE(status([bad](Status& m) { m.time_s = bad; }));
  for (const double bad : {-0.1, 1.1, std::nan("")})
    EXPECT_TRUE(status([bad](Status& m) { m.tools = {{"t", {bad}}}; }));
  EXPECT_TRUE(status([](Status& m) { m.tools = {{"t", std::vector<double>(kMastersMax + 1, 0.0)}}; }));
  EXPECT_TRUE(status([](Status& m) { m.tools.assign(kToolsMax + 1, {"t", {1.0}}); }));
  EXPECT_TRUE(
      status([](Status& m) { m.seats.assign(kListedSeatsMax + 1, {"s", AccessRole::kTrainee, false, false, false}); }));
  EXPECT_TRUE(status([](Status& m) { m.seats = {{"s", static_cast<AccessRole>(kAccessRoles), false, false, false}}; }));
}

TEST(RpcCodec, RejectsOutOfRangeFieldsOfAService) {
  const auto refuses = [](const Body& body) {
    const auto out = encode({1, body});
    return !out && out.error() == FrameError::kOutOfRange;
  };
  const auto elsewhere = [&](auto change) {
    Elsewhere m{.address = "lab-b:7000", .voucher = Bytes(1), .session = "lesson"};
    change(m);
    return refuses(m);
  };
  EXPECT_FALSE(elsewhere([](Elsewhere&) {}));
  EXPECT_FALSE(elsewhere([](Elsewhere& m) { m.address = "[::1]:1"; }));
  EXPECT_FALSE(elsewhere([](Elsewhere& m) { m.voucher.resize(kVoucherMax); }));
  EXPECT_TRUE(elsewhere([](Elsewhere& m) { m.voucher.resize(kVoucherMax + 1); }));
  EXPECT_TRUE(elsewhere([](Elsewhere& m) { m.voucher.clear(); }));
  EXPECT_TRUE(elsewhere([](Elsewhere& m) { m.session = ""; }));
  for (const std::string& bad : {std::string(), std::string("lab-b"), std::string("a b:1"), std::string("a\"b:1"),
                                 std::string("a\x1b:1"), std::string(kAddressMax, 'a') + ":1"}) {
    EXPECT_TRUE(elsewhere([&](Elsewhere& m) { m.address = bad; })) << bad;
    EXPECT_TRUE(refuses(EnrollAck{"touch-01", {bad}})) << bad;
  }
  EXPECT_FALSE(refuses(EnrollAck{"touch-01", std::vector<std::string>(kMembersMax, "lab-a:1")}));
  EXPECT_TRUE(refuses(EnrollAck{"touch-01", std::vector<std::string>(kMembersMax + 1, "lab-a:1")}));
  SessionList list{{{{}, "lesson", SessionPhase::kRunning, {}, "desk-a"}}, false, 0, true};
  EXPECT_FALSE(refuses(list));
  list.sessions[0].server = "desk a";
  EXPECT_TRUE(refuses(list));
}

/// A client of version 2 rejects every frame with a field that it does not know, so nothing of a service may appear
/// in frames for it.
TEST(RpcCodec, EncodesFramesWithoutServiceAsVersion2) {
  const auto hex = [](const Body& body) { return to_hex(encode({1, body})->bytes().subspan(kLengthSize)); };
  EXPECT_EQ(hex(Enroll{}), "0801100132120a10" + std::string(32, '0'));
  EXPECT_EQ(hex(EnrollAck{"a"}), "080110013a030a0161");
  EXPECT_EQ(hex(SessionListRequest{5}), "0801100142020805");
  EXPECT_EQ(hex(SessionList{{{{}, "a", SessionPhase::kRunning, {}}}, true, 3}),
            "080110014a1d0a170a10" + std::string(32, '0') + "120161180110011803");
}

TEST(RpcCodec, RejectsTextThatIsNoUtf8OrControlsATerminal) {
  const auto good = [](const std::string& text) {
    return encode({0, ErrorReply{ErrorCode::kFull, text, 0}}).has_value();
  };
  for (const char* text : {"", "plain words: (cause), remedy!", "\xc3\xa4\xe2\x82\xac\xf0\x9f\x99\x82", "\xef\xbf\xbd",
                           "\xf4\x8f\xbf\xbf", "\xc2\xa0"})
    EXPECT_TRUE(good(text)) << text;
  for (const char* text : {"\x1b[2J", "a\nb", "\x7f",
                           "\xc2\x9b"
                           "2J",
                           "\xff", "\x80", "\xc0\xaf", "\xc3", "\xe2\x82", "\xe0\x80\xaf", "\xed\xa0\x80",
                           "\xf0\x80\x80\xaf", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80"})
    EXPECT_FALSE(good(text)) << text;
  EXPECT_FALSE(good(std::string("a\0b", 3)));
  EXPECT_TRUE(good(std::string(kTextMax, 'a')));
  EXPECT_FALSE(good(std::string(kTextMax + 1, 'a')));
}

}  // namespace
}  // namespace tandem::rpc
