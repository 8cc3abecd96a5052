#include "common/auth/ticket.h"

#include <gtest/gtest.h>

#include "common/auth/base32.h"
#include "common/transport/digest.h"
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

TEST(Ticket, HasTheDocumentedLayout) {
  const auto key = test::ticket_key();
  const auto bytes = signed_sample(key);
  const auto hex = to_hex(bytes);
  const auto at = [&](std::size_t from, std::size_t count) { return hex.substr(2 * from, 2 * count); };
  EXPECT_EQ(at(0, 1), "01");    // version
  EXPECT_EQ(at(1, 1), "01");    // trainee
  EXPECT_EQ(at(2, 2), "f401");  // 500
  EXPECT_EQ(at(8, 16), "0102030405060708090a0b0c0d0e0f10");
  EXPECT_EQ(at(24, 4), "32333435");           // session: 50, 51, ...
  EXPECT_EQ(at(40, 4), "64656667");           // workstation: 100, 101, ...
  EXPECT_EQ(at(72, 8), "747261696e656500");   // "trainee", zero
  EXPECT_EQ(at(104, 8), "00d2496b00000000");  // 1 800 000 000
  EXPECT_EQ(at(120, 8), "0700000000000000");
  // The first test key of RFC 8032 has other bytes; our key is identified by the SHA-256 of its public key.
  const auto hash = transport::sha256(key.verifier().key);
  EXPECT_EQ(at(4, 4), to_hex(std::span(hash).first(4)));
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
  EXPECT_EQ(rule_of(std::span(bytes).first(191), key, right), TicketCheck::kLength);
  EXPECT_EQ(rule_of({}, key, right), TicketCheck::kLength);
  EXPECT_EQ(rule_of(bytes, test::ticket_key(1), right), TicketCheck::kKey);
  EXPECT_EQ(rule_of(bytes, key, use([](TicketUse& u) { u.workstation.sha256[31] ^= std::byte{1}; })),
            TicketCheck::kWorkstation);
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
}

TEST(Ticket, RejectsEveryFlippedBit) {
  const auto key = test::ticket_key();
  const TicketUse use = sample_use(sample_ticket());
  const auto bytes = signed_sample(key);
  for (std::size_t bit = 0; bit < 8 * kTicketSize; ++bit) {
    auto changed = bytes;
    changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    const TicketCheck rule = rule_of(changed, key, use);
    EXPECT_EQ(rule, bit < 8                 ? TicketCheck::kVersion
                    : bit >= 32 && bit < 64 ? TicketCheck::kKey
                                            : TicketCheck::kSignature)
        << "bit " << bit;
  }
}

TEST(Ticket, RejectsAnEditedRoleByItsSignature) {
  const auto key = test::ticket_key();
  auto bytes = signed_sample(key);
  bytes[1] = static_cast<std::byte>(AccessRole::kInstructor);
  EXPECT_EQ(rule_of(bytes, key, sample_use(sample_ticket())), TicketCheck::kSignature);
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
  EXPECT_TRUE(refused([](Ticket& t) { t.seat = ""; }));
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
    auto bytes = test::random_bytes(random, i % 4 == 0 ? random.below(400) : kTicketSize);
    if (bytes.size() > 8 && i % 2 == 0) {  // so that some reach the signature check
      bytes[0] = std::byte{1};
      for (std::size_t k = 0; k < 4; ++k) bytes[4 + k] = static_cast<std::byte>(key.verifier().kid >> (8 * k) & 0xff);
    }
    EXPECT_FALSE(check_ticket(bytes, key.verifier(), sample_use(sample_ticket())));
  }
}

TEST(Ticket, ReportsTheErrorInItsText) {
  const std::string text = ticket_text(signed_sample(test::ticket_key()));
  EXPECT_EQ(text.size(), 7 + base32_length(kTicketSize));
  EXPECT_FALSE(ticket_from_text(text.substr(1)));
  EXPECT_FALSE(ticket_from_text(text.substr(0, text.size() - 8)));
  EXPECT_FALSE(ticket_from_text(text + "!"));
  EXPECT_FALSE(ticket_from_text(""));
  EXPECT_TRUE(ticket_from_text("ticket:" + std::string("-") + text.substr(7)));
}

TEST(AccessRole, HasNamesBothWays) {
  for (std::uint8_t i = 0; i < kAccessRoles; ++i)
    EXPECT_EQ(access_role_named(to_text(static_cast<AccessRole>(i))), static_cast<AccessRole>(i));
  EXPECT_FALSE(access_role_named("admin"));
}

}  // namespace
}  // namespace tandem::auth
