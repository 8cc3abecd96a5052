#include "common/auth/ticket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/auth/base32.h"
#include "proto/rpc/ticket_codec.h"
#include "tests/common/auth/edited_ticket.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::kNow;
using test::sample_ticket;
using test::sample_use;

TicketBytes signed_sample(const TicketKey& key, const Ticket& ticket = sample_ticket()) {
  const auto bytes = sign_ticket(ticket, key);
  EXPECT_TRUE(bytes) << bytes.error();
  return bytes ? *bytes : TicketBytes{};
}

TicketCheck rule_of(std::span<const std::byte> bytes, const TicketKey& key, const TicketUse& use,
                    std::int64_t* seconds = nullptr) {
  const auto got = check_ticket(bytes, key.verifier(), use);
  EXPECT_FALSE(got);
  if (got) return TicketCheck::kBookFull;
  if (seconds != nullptr) *seconds = got.error().seconds;
  EXPECT_FALSE(to_text(got.error()).empty());
  return got.error().rule;
}

TEST(Ticket, SurvivesARoundTrip) {
  const auto key = test::ticket_key();
  const Ticket ticket = sample_ticket();
  const auto got = check_ticket(signed_sample(key), key.verifier(), sample_use(ticket));
  ASSERT_TRUE(got) << to_text(got.error());
  EXPECT_EQ(*got, ticket);
  EXPECT_EQ(ticket_from_text(ticket_text(signed_sample(key))), signed_sample(key));
}

/// The sample ticket as another program writes it: ticket.proto by hand and Ed25519 of Python's `cryptography`.
TEST(Ticket, HasTheDocumentedLayout) {
  EXPECT_EQ(to_hex(signed_sample(test::ticket_key())),
            "08021556475aa71a62080110f4031a100102030405060708090a0b0c0d0e0f10221032333435363738393a3b3c"
            "3d3e3f40412a206465666768696a6b6c6d6e6f707172737475767778797a7b7c7d7e7f80818283320774726169"
            "6e65653880a4a7da064090c0a7da0648072240a69804cbdd76ae0e0f817c1554c4aa5c6d1da5a8ac31ad99f52e"
            "78f36f7a9e14a2d29308c5d0ae22e07b82514c004bed8070ea7f23cdc6a155106d3bf57a6c08");
}

TEST(Ticket, NeverExceedsItsLargestSize) {
  Ticket t = sample_ticket();
  t.role = AccessRole::kRecorder;
  t.seat = t.person = std::string(Ticket::kNameMax, 'z');
  t.force_scale = Ticket::kFullForce;
  t.not_before = std::numeric_limits<std::int64_t>::max() - Ticket::kLifeMax;
  t.not_after = std::numeric_limits<std::int64_t>::max();
  t.epoch_min = ~std::uint64_t{0};
  const auto bytes = sign_ticket(t, test::ticket_key());
  ASSERT_TRUE(bytes);
  EXPECT_LE(bytes->size(), rpc::kSignedTicketMax);
  EXPECT_EQ(ticket_from_text(ticket_text(*bytes)), *bytes);
}

/// The name is signed with the rest. A ticket without a name is byte for byte one of the releases before names
/// (HasTheDocumentedLayout).
TEST(Ticket, CarriesTheNameOfItsPerson) {
  const auto key = test::ticket_key();
  Ticket ticket = sample_ticket();
  ticket.person = "ann";
  const auto bytes = signed_sample(key, ticket);
  const auto got = check_ticket(bytes, key.verifier(), sample_use(ticket));
  ASSERT_TRUE(got) << to_text(got.error());
  EXPECT_EQ(got->person, "ann");
  auto edited = *rpc::decode_signed_ticket(bytes);
  auto content = *rpc::decode_ticket_content(edited.content);
  content.person = "bob";
  edited.content = rpc::encode(content);
  EXPECT_EQ(rule_of(rpc::encode(edited), key, sample_use(ticket)), TicketCheck::kSignature);
  content.person.clear();
  edited.content = rpc::encode(content);
  EXPECT_EQ(rule_of(rpc::encode(edited), key, sample_use(ticket)), TicketCheck::kSignature) << "the name was removed";
  ticket.person = "a/b";
  EXPECT_FALSE(sign_ticket(ticket, key));
}

/// Format 1: 192 bytes at fixed offsets, which begin with 1.
TEST(Ticket, RejectsFormat1WithARemedy) {
  const auto key = test::ticket_key();
  std::vector<std::byte> old(192, std::byte{7});
  old[0] = std::byte{1};
  EXPECT_EQ(rule_of(old, key, sample_use(sample_ticket())), TicketCheck::kVersion);
  EXPECT_NE(to_text(TicketError{TicketCheck::kVersion, 0, {}}).find("`tandem-server ticket`"), std::string::npos);
  const auto text = ticket_from_text("ticket:" + to_base32(old));
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().find("format 1"), std::string::npos) << text.error();
  EXPECT_NE(text.error().find("ask for a new one, which `tandem-server ticket`"), std::string::npos) << text.error();
}

TEST(Ticket, RejectsALaterFormatByItsVersion) {
  const auto key = test::ticket_key();
  auto ticket = *rpc::decode_signed_ticket(signed_sample(key));
  ticket.version = 3;
  EXPECT_EQ(rule_of(rpc::encode(ticket), key, sample_use(sample_ticket())), TicketCheck::kVersion);
}

/// A signer with the server's key can write any content; each value has one encoding, and ranges hold.
TEST(Ticket, RejectsSignedContentThatIsNoTicket) {
  const auto key = test::ticket_key();
  const auto resigned = [&](std::vector<std::byte> content) {
    auto ticket = *rpc::decode_signed_ticket(signed_sample(key));
    std::vector<std::byte> message;
    for (const char c : std::string("tandem ticket v2") + '\0') message.push_back(static_cast<std::byte>(c));
    message.insert(message.end(), content.begin(), content.end());
    ticket.signature = key.sign(message);
    ticket.content = std::move(content);
    return rpc::encode(ticket);
  };
  const auto sample = sample_ticket();
  const TicketUse use = sample_use(sample);
  const auto content = rpc::decode_signed_ticket(signed_sample(key))->content;
  EXPECT_TRUE(check_ticket(resigned(content), key.verifier(), use));
  auto unknown = content;
  unknown.insert(unknown.end(), {std::byte{0x58}, std::byte{1}});  // field 11
  EXPECT_EQ(rule_of(resigned(unknown), key, use), TicketCheck::kContent);
  auto repeated = content;
  repeated.insert(repeated.end(), {std::byte{0x48}, std::byte{7}});  // epoch_min again
  EXPECT_EQ(rule_of(resigned(repeated), key, use), TicketCheck::kContent);
  EXPECT_EQ(rule_of(resigned({}), key, use), TicketCheck::kContent);
  const auto with = [&](auto change) {
    auto c = *rpc::decode_ticket_content(content);
    change(c);
    return rule_of(resigned(rpc::encode(c)), key, use);
  };
  EXPECT_EQ(with([](rpc::TicketContent& c) { c.role = 6; }), TicketCheck::kContent);
  EXPECT_EQ(with([](rpc::TicketContent& c) { c.role = 257; }), TicketCheck::kContent) << "1 in the lowest byte";
  EXPECT_EQ(with([](rpc::TicketContent& c) { c.force_scale = 65536 + 500; }), TicketCheck::kContent);
  EXPECT_EQ(with([](rpc::TicketContent& c) { c.seat = "a b"; }), TicketCheck::kContent);
  for (const std::string& bad : {std::string("a b"), std::string("\n"), std::string("\xc3\xa4"), std::string(33, 'x')})
    EXPECT_EQ(with([&bad](rpc::TicketContent& c) { c.person = bad; }), TicketCheck::kContent) << bad;
  EXPECT_EQ(with([](rpc::TicketContent& c) { c.not_before = -1; }), TicketCheck::kContent);
  EXPECT_EQ(with([](rpc::TicketContent& c) { c.not_before = std::numeric_limits<std::int64_t>::min(); }),
            TicketCheck::kContent);
}

TEST(TicketKey, IsEd25519OfRfc8032) {
  Secret<32> seed;
  ASSERT_TRUE(from_hex("9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60", seed.bytes));
  const TicketKey key(seed);
  EXPECT_EQ(to_hex(key.verifier().key), "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a");
  EXPECT_EQ(to_hex(key.sign({})),
            "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46bd25bf5f059"
            "5bbe24655141438e7a100b");
  const auto again = TicketKey::from_text(key.to_text().bytes());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->verifier().key, key.verifier().key);
  const auto text = key.to_text();
  for (std::size_t cut = 0; cut < text.size(); ++cut) EXPECT_FALSE(TicketKey::from_text(text.bytes().first(cut)));
}

TEST(Ticket, ReportsTheNameOfTheBrokenRule) {
  const auto key = test::ticket_key();
  const Ticket ticket = sample_ticket();
  const auto bytes = signed_sample(key);
  const auto use = [&](auto change) {
    TicketUse u = sample_use(ticket);
    change(u);
    return u;
  };
  const TicketUse right = sample_use(ticket);
  for (std::size_t cut = 0; cut < bytes.size(); ++cut)
    EXPECT_EQ(rule_of(std::span(bytes).first(cut), key, right), TicketCheck::kFormat) << cut;
  EXPECT_EQ(rule_of(bytes, test::ticket_key(1), right), TicketCheck::kKey);
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.workstation.sha256[31] ^= std::byte{1}; })),
            TicketCheck::kWorkstation);
  EXPECT_TRUE(check_ticket(bytes, key.verifier(), use([](TicketUse& u) { u.enrolled_at = test::kNow; })))
      << "enrolled in the same second";
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.enrolled_at = test::kNow + 1; })), TicketCheck::kEnrolment);
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.session_id[0] ^= std::byte{1}; })), TicketCheck::kSession);
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.epoch = 6; })), TicketCheck::kEpoch);
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.seat = "trainer"; })), TicketCheck::kSeat);
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.seat = ""; })), TicketCheck::kSeat);
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.role = AccessRole::kInstructor; })), TicketCheck::kRole);
  EXPECT_TRUE(check_ticket(bytes, key.verifier(), use([](TicketUse& u) { u.role.reset(); })));
  EXPECT_TRUE(check_ticket(bytes, key.verifier(), use([](TicketUse& u) { u.epoch = 8; })));
}

TEST(Ticket, IsValidFromItsFirstToItsLastSecond) {
  const auto key = test::ticket_key();
  const Ticket ticket = sample_ticket();
  const auto bytes = signed_sample(key);
  const auto at = [&](std::int64_t now) {
    TicketUse u = sample_use(ticket);
    u.now = now;
    return u;
  };
  EXPECT_TRUE(check_ticket(bytes, key.verifier(), at(kNow)));
  EXPECT_TRUE(check_ticket(bytes, key.verifier(), at(kNow + 3600)));
  std::int64_t s = 0;
  EXPECT_EQ(rule_of(bytes, key, at(kNow + 3601), &s), TicketCheck::kExpired);
  EXPECT_EQ(s, 1);
  EXPECT_EQ(rule_of(bytes, key, at(kNow - 2), &s), TicketCheck::kNotYet);
  EXPECT_EQ(s, 2);
  EXPECT_EQ(to_text(TicketError{TicketCheck::kExpired, 1, {}}), "the ticket expired 1 s ago; ask for a new one");
  EXPECT_EQ(to_text(TicketError{TicketCheck::kExpired, 7200, {}}), "the ticket expired 2 h ago; ask for a new one");
  EXPECT_EQ(to_text(TicketError{TicketCheck::kNotYet, 2, {}}), "the ticket is valid only in 2 s; wait");
}

TEST(Ticket, ThatIsADayTooOldOrMinutesTooNewNamesTheClockAsTheCause) {
  constexpr std::int64_t kDay = 86400;
  for (const auto& [fault, span] : {std::pair{TicketError{TicketCheck::kExpired, 365 * kDay, {}}, "365 days ago"},
                                    std::pair{TicketError{TicketCheck::kExpired, kDay, {}}, "24 h ago"},
                                    std::pair{TicketError{TicketCheck::kNotYet, 365 * kDay, {}}, "in 365 days"},
                                    std::pair{TicketError{TicketCheck::kNotYet, 300, {}}, "in 5 min"}}) {
    const std::string text = to_text(fault);
    EXPECT_TRUE(text.starts_with("by the clock of this server, the ticket ")) << text;
    EXPECT_NE(text.find(span), std::string::npos) << text;
    EXPECT_NE(text.find("clock of this server is wrong"), std::string::npos) << text;
  }
  EXPECT_EQ(to_text(TicketError{TicketCheck::kExpired, kDay - 1, {}}),
            "the ticket expired 23 h ago; ask for a new one");
}

TEST(Ticket, RejectsEveryFlippedBit) {
  const auto key = test::ticket_key();
  const auto sample = sample_ticket();
  const TicketUse use = sample_use(sample);
  const auto bytes = signed_sample(key);
  // Layout: 08 version, 15 kid, 1a length content, 22 40 signature.
  const std::size_t content_at = 9, content_size = rpc::decode_signed_ticket(bytes)->content.size();
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto changed = bytes;
    const std::size_t at = bit / 8;
    changed[at] ^= static_cast<std::byte>(1U << bit % 8);
    const TicketCheck rule = rule_of(changed, key, use);
    const bool in_content = at >= content_at && at < content_at + content_size;
    const bool in_signature = at >= bytes.size() - sizeof(Signature);
    if (in_content || in_signature) {
      EXPECT_EQ(rule, TicketCheck::kSignature) << "bit " << bit;
    } else if (at >= 3 && at < 7) {
      EXPECT_EQ(rule, TicketCheck::kKey) << "bit " << bit;
    } else {
      EXPECT_TRUE(rule == TicketCheck::kFormat || rule == TicketCheck::kVersion) << "bit " << bit;
    }
  }
}

TEST(Ticket, ClaimsTheKeyOfItsWorkstation) {
  EXPECT_EQ(claimed_workstation(signed_sample(test::ticket_key())), sample_ticket().workstation);
  EXPECT_EQ(claimed_workstation({}), std::nullopt);
}

TEST(Ticket, RejectsAnEditedRoleByItsSignature) {
  const auto key = test::ticket_key();
  const auto edited = test::with_role(signed_sample(key), AccessRole::kInstructor);
  EXPECT_EQ(claimed_role(edited), AccessRole::kInstructor);
  EXPECT_EQ(rule_of(edited, key, sample_use(sample_ticket())), TicketCheck::kSignature);
}

TEST(Ticket, RefusesToSignFieldsOutOfRange) {
  const auto key = test::ticket_key();
  const auto refused = [&](auto change) {
    Ticket t = sample_ticket();
    change(t);
    return !sign_ticket(t, key).has_value();
  };
  EXPECT_TRUE(refused([](Ticket& t) { t.role = static_cast<AccessRole>(6); }));
  EXPECT_TRUE(refused([](Ticket& t) { t.force_scale = 0; }));
  EXPECT_TRUE(refused([](Ticket& t) { t.force_scale = 1001; }));
  EXPECT_TRUE(refused([](Ticket& t) { t.seat = std::string(33, 'a'); }));
  EXPECT_TRUE(refused([](Ticket& t) { t.seat = "a b"; }));
  EXPECT_FALSE(refused([](Ticket& t) { t.seat = ""; })) << "a console that watches";
  EXPECT_TRUE(refused([](Ticket& t) { t.person = std::string(33, 'a'); }));
  EXPECT_TRUE(refused([](Ticket& t) { t.not_after = t.not_before + Ticket::kLifeMax + 1; }));
  EXPECT_TRUE(refused([](Ticket& t) { t.not_after = t.not_before - 1; }));
  EXPECT_FALSE(refused([](Ticket& t) { t.not_after = t.not_before + Ticket::kLifeMax; }));
  EXPECT_FALSE(refused([](Ticket& t) { t.seat = "", t.role = AccessRole::kRecorder; }));
  EXPECT_FALSE(refused([](Ticket& t) { t.seat = "", t.role = AccessRole::kInstructor; })) << "at a console";
  EXPECT_FALSE(refused([](Ticket& t) { t.seat = std::string(32, 'a'); }));
}

TEST(Ticket, RejectsRandomBytes) {
  const auto key = test::ticket_key();
  RandomStream random(9);
  const std::uint64_t count = test::seeds(2000);
  for (std::uint64_t i = 0; i < count; ++i) {
    auto bytes = test::random_bytes(random, random.below(400));
    if (i % 2 == 0) {  // so that some reach the signature check
      rpc::SignedTicket ticket{.version = Ticket::kVersion, .kid = key.verifier().kid, .content = bytes};
      std::ranges::copy(test::random_bytes(random, sizeof ticket.signature), ticket.signature.begin());
      bytes = rpc::encode(ticket);
    }
    EXPECT_FALSE(check_ticket(bytes, key.verifier(), sample_use(sample_ticket())));
  }
}

TEST(Ticket, ReportsTheErrorInItsText) {
  const std::string text = ticket_text(signed_sample(test::ticket_key()));
  EXPECT_EQ(text.size(), 7 + base32_length(signed_sample(test::ticket_key()).size()));
  EXPECT_FALSE(ticket_from_text(text.substr(1)));
  EXPECT_FALSE(ticket_from_text(text.substr(0, text.size() - 8)));
  EXPECT_FALSE(ticket_from_text(text + "!"));
  EXPECT_FALSE(ticket_from_text(""));
  EXPECT_FALSE(ticket_from_text("  \n"));
  EXPECT_TRUE(ticket_from_text("  \t" + text + " \r\n")) << "copied from an indented line";
  EXPECT_TRUE(ticket_from_text("ticket:" + std::string("-") + text.substr(7)));
}

TEST(AccessRole, HasNamesBothWays) {
  for (std::uint8_t i = 0; i < kAccessRoles; ++i)
    EXPECT_EQ(access_role_named(to_text(static_cast<AccessRole>(i))), static_cast<AccessRole>(i));
  EXPECT_FALSE(access_role_named("admin"));
}

}  // namespace
}  // namespace tandem::auth
