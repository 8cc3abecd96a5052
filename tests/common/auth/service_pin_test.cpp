#include "common/auth/service_pin.h"

#include <gtest/gtest.h>

#include "common/auth/tls_key.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::kNow;
using Bytes = std::vector<std::byte>;

constexpr std::int64_t kDay = Voucher::kDay;

TicketKey service_key(unsigned start = 0) { return test::ticket_key(start); }
ServicePin pin_of(const TicketKey& key) { return {key.verifier().key, {}, 0}; }
KeyFingerprint server(unsigned start = 60) { return {test::counting<32>(start)}; }
Voucher sample_voucher() { return {"desk-a", server(), kNow, kNow + 400 * kDay}; }
Bytes signed_voucher(const TicketKey& key, const Voucher& voucher = sample_voucher()) {
  const auto bytes = sign_voucher(voucher, key);
  EXPECT_TRUE(bytes) << bytes.error();
  return bytes.value_or(Bytes{});
}
Bytes change_of(const TicketKey& from, const TicketKey& to, std::int64_t grace = 30 * kDay, std::int64_t at = kNow) {
  const auto bytes = sign_key_change({from.verifier().key, to.verifier().key, at, at + grace}, from);
  EXPECT_TRUE(bytes) << bytes.error();
  return bytes.value_or(Bytes{});
}
VoucherCheck rule_of(const Bytes& bytes, const ServicePin& pin, std::int64_t now = kNow,
                     const KeyFingerprint& of = server()) {
  const auto got = check_voucher(bytes, pin, of, now);
  EXPECT_FALSE(got);
  if (got) return VoucherCheck::kFormat;
  EXPECT_FALSE(to_text(got.error()).empty());
  return got.error().rule;
}
Bytes credential(const TicketKey& key, const Bytes& voucher, std::vector<Bytes> changes = {}) {
  return rpc::encode(rpc::MemberCredential{key.verifier().key, voucher, std::move(changes)});
}

TEST(Voucher, IsAcceptedFromItsFirstToItsLastSecondForItsServerOnly) {
  const TicketKey key = service_key();
  const Bytes bytes = signed_voucher(key);
  EXPECT_LE(bytes.size(), rpc::kStatementMax);
  for (const std::int64_t now : {kNow, kNow + 400 * kDay})
    EXPECT_EQ(check_voucher(bytes, pin_of(key), server(), now).value(), sample_voucher());
  EXPECT_EQ(rule_of(bytes, pin_of(key), kNow - 1), VoucherCheck::kNotYet);
  EXPECT_EQ(rule_of(bytes, pin_of(key), kNow + 400 * kDay + 1), VoucherCheck::kExpired);
  EXPECT_EQ(rule_of(bytes, pin_of(key), kNow, server(61)), VoucherCheck::kServer);
  const auto late = check_voucher(bytes, pin_of(key), server(), kNow + 403 * kDay);
  ASSERT_FALSE(late);
  EXPECT_NE(to_text(late.error()).find("server desk-a expired 3 days ago"), std::string::npos);
}

TEST(Voucher, OfAnotherServiceIsRejectedWhateverItClaims) {
  const TicketKey key = service_key(), other = service_key(7);
  EXPECT_EQ(rule_of(signed_voucher(other), pin_of(key)), VoucherCheck::kService);
  // With the key id of the pinned key, the signature decides.
  auto forged = rpc::decode_service_statement(signed_voucher(other)).value();
  forged.kid = key.verifier().kid;
  EXPECT_EQ(rule_of(rpc::encode(forged), pin_of(key)), VoucherCheck::kSignature);
}

TEST(Voucher, HasNoOtherMeaningThanItsLabel) {
  const TicketKey key = service_key();
  // A ticket, or a change of the key, under the same key is no voucher, although the signature is one of that key.
  auto moved = rpc::decode_service_statement(change_of(key, service_key(3))).value();
  EXPECT_EQ(rule_of(rpc::encode(moved), pin_of(key)), VoucherCheck::kSignature);
  auto ticket = test::sample_ticket();
  const auto bytes = sign_ticket(ticket, key);
  EXPECT_EQ(rule_of({bytes->begin(), bytes->end()}, pin_of(key)), VoucherCheck::kVersion);
}

TEST(Voucher, SurvivesNoFlippedBitAndNoPrefix) {
  const TicketKey key = service_key();
  const Bytes bytes = signed_voucher(key);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    Bytes changed = bytes;
    changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_FALSE(check_voucher(changed, pin_of(key), server(), kNow)) << bit;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(check_voucher(std::span(bytes).first(size), pin_of(key), server(), kNow));
}

TEST(Voucher, IsNotSignedOutOfItsRanges) {
  const TicketKey key = service_key();
  const auto rejected = [&](auto change) {
    Voucher v = sample_voucher();
    change(v);
    return !sign_voucher(v, key).has_value();
  };
  EXPECT_TRUE(rejected([](Voucher& v) { v.name.clear(); }));
  EXPECT_TRUE(rejected([](Voucher& v) { v.name = "desk a"; }));
  EXPECT_TRUE(rejected([](Voucher& v) { v.not_before = -1; }));
  EXPECT_TRUE(rejected([](Voucher& v) { v.not_after = v.not_before - 1; }));
  EXPECT_TRUE(rejected([](Voucher& v) { v.not_after = v.not_before + Voucher::kLifeMax + 1; }));
  EXPECT_FALSE(rejected([](Voucher& v) { v.not_after = v.not_before + Voucher::kLifeMax; }));
}

TEST(ServicePin, FollowsAChainOfKeysAndKeepsTheOldOneForItsGrace) {
  const TicketKey first = service_key(), second = service_key(20), third = service_key(40);
  const std::vector<Bytes> chain{change_of(first, second), change_of(second, third, 5 * kDay)};
  const ServicePin newest = follow_key_changes(pin_of(first), chain);
  EXPECT_EQ(newest, (ServicePin{third.verifier().key, second.verifier().key, kNow + 5 * kDay}));
  EXPECT_EQ(follow_key_changes(pin_of(second), chain), newest);
  EXPECT_EQ(follow_key_changes(newest, chain), newest);
  EXPECT_TRUE(check_voucher(signed_voucher(third), newest, server(), kNow));
  EXPECT_TRUE(check_voucher(signed_voucher(second), newest, server(), kNow + 5 * kDay));
  EXPECT_EQ(rule_of(signed_voucher(second), newest, kNow + 5 * kDay + 1), VoucherCheck::kReplaced);
  EXPECT_EQ(rule_of(signed_voucher(first), newest), VoucherCheck::kService);
}

TEST(ServicePin, FollowsNoStatementThatItsKeyHasNotSigned) {
  const TicketKey first = service_key(), evil = service_key(90);
  const ServicePin pin = pin_of(first);
  const KeyChange wanted{first.verifier().key, evil.verifier().key, kNow, kNow + kDay};
  const std::vector<Bytes> forged{sign_key_change(wanted, evil).value()};
  EXPECT_EQ(follow_key_changes(pin, forged), pin);
  const std::vector<Bytes> of_another{change_of(evil, service_key(91))};
  EXPECT_EQ(follow_key_changes(pin, of_another), pin);
  // The pinned key has signed it, and it names another key.
  const KeyChange unrelated{service_key(91).verifier().key, evil.verifier().key, kNow, kNow + kDay};
  const std::vector<Bytes> misnamed{sign_key_change(unrelated, first).value()};
  EXPECT_EQ(follow_key_changes(pin, misnamed), pin);
  const std::vector<Bytes> voucher{signed_voucher(first)};
  EXPECT_EQ(follow_key_changes(pin, voucher), pin);
  Bytes flipped = change_of(first, evil);
  for (std::size_t bit = 0; bit < 8 * flipped.size(); ++bit) {
    std::vector<Bytes> one{flipped};
    one[0][bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_EQ(follow_key_changes(pin, one), pin) << bit;
  }
}

TEST(ServicePin, AcceptsAMemberByItsCredentialAndPinsTheNewKey) {
  const TicketKey first = service_key(), second = service_key(20);
  const Bytes shown = credential(second, signed_voucher(second), {change_of(first, second)});
  const auto member = accept_member(shown, pin_of(first), server(), kNow);
  ASSERT_TRUE(member) << member.error();
  EXPECT_EQ(member->pin.key, second.verifier().key);
  EXPECT_EQ(member->voucher.name, "desk-a");
  // Without the statement the same voucher is of an unknown key. The key that a credential names has no effect.
  EXPECT_FALSE(accept_member(credential(second, signed_voucher(second)), pin_of(first), server(), kNow));
  EXPECT_FALSE(accept_member(credential(first, signed_voucher(second)), pin_of(first), server(), kNow));
  // Replayed by another server.
  EXPECT_FALSE(accept_member(shown, pin_of(first), server(61), kNow));
  EXPECT_FALSE(accept_member({}, pin_of(first), server(), kNow));
}

TEST(ServicePin, IsFirstTakenOnlyFromAServerThatIsAMember) {
  const TicketKey key = service_key(), other = service_key(5);
  EXPECT_EQ(first_pin(credential(key, signed_voucher(key)), server(), kNow).value(), pin_of(key));
  EXPECT_FALSE(first_pin(credential(key, signed_voucher(other)), server(), kNow));
  EXPECT_FALSE(first_pin(credential(key, signed_voucher(key)), server(61), kNow));
  EXPECT_FALSE(first_pin(credential(key, signed_voucher(key)), server(), kNow + 401 * kDay));
}

TEST(ServicePin, OfAClientThatEnrolsDuringTheGraceAcceptsServersOfTheOldKey) {
  const TicketKey first = service_key(), second = service_key(20), third = service_key(40);
  const std::vector<Bytes> chain{change_of(first, second), change_of(second, third, 5 * kDay)};
  const ServicePin pin = first_pin(credential(third, signed_voucher(third), chain), server(), kNow).value();
  EXPECT_EQ(pin, (ServicePin{third.verifier().key, second.verifier().key, kNow + 5 * kDay}));
  EXPECT_TRUE(check_voucher(signed_voucher(second), pin, server(), kNow + 5 * kDay));
  EXPECT_EQ(rule_of(signed_voucher(second), pin, kNow + 5 * kDay + 1), VoucherCheck::kReplaced);
  // A statement that the old key has not signed changes nothing.
  const KeyChange wanted{second.verifier().key, third.verifier().key, kNow, kNow + kDay};
  const std::vector<Bytes> forged{sign_key_change(wanted, first).value()};
  EXPECT_EQ(first_pin(credential(third, signed_voucher(third), forged), server(), kNow).value(), pin_of(third));
}

TEST(ServicePin, TellsARotationFromAnotherService) {
  const std::string replaced = to_text(VoucherError{VoucherCheck::kReplaced});
  for (const char* words : {"service rotate", "--grace-days", "another server of the service", "service vouch"})
    EXPECT_NE(replaced.find(words), std::string::npos) << replaced;
  const std::string unknown = to_text(VoucherError{VoucherCheck::kService});
  for (const char* words : {"another service", "rotated its key", "enrol there"})
    EXPECT_NE(unknown.find(words), std::string::npos) << unknown;
}

TEST(MemberCredential, TravelsInACertificateAndLeavesItsKeyAsItWas) {
  const TlsKey key = TlsKey::generate();
  const std::vector<Bytes> chain(rpc::kKeyChangesMax, change_of(service_key(), service_key(9)));
  const Bytes shown = credential(service_key(), signed_voucher(service_key()), chain);
  EXPECT_LE(shown.size(), rpc::kCredentialMax);
  const Certificate with = Certificate::self_signed(key, "tandem server", test::counting<16>(), kNow, shown);
  EXPECT_EQ(credential_in(with.handle()), shown);
  EXPECT_EQ(with.fingerprint(), key.fingerprint());
  const std::string pem = with.to_pem();
  const auto again = Certificate::from_pem(std::as_bytes(std::span(pem)));
  ASSERT_TRUE(again);
  EXPECT_EQ(credential_in(again->handle()), shown);
  EXPECT_TRUE(
      credential_in(Certificate::self_signed(key, "tandem server", test::counting<16>(), kNow).handle()).empty());
}

TEST(MemberCredential, HasOneEncodingAndBounds) {
  const TicketKey key = service_key();
  const Bytes shown = credential(key, signed_voucher(key), {change_of(key, service_key(9))});
  const auto decoded = rpc::decode_member_credential(shown);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(rpc::encode(*decoded), shown);
  Bytes longer = shown;
  longer.push_back(std::byte{0x20});  // an unknown field
  longer.push_back(std::byte{1});
  EXPECT_FALSE(rpc::decode_member_credential(longer));
  const std::vector<Bytes> many(rpc::kKeyChangesMax + 1, Bytes(1));
  EXPECT_FALSE(rpc::decode_member_credential(credential(key, {}, many)));
  EXPECT_FALSE(rpc::decode_member_credential(credential(key, Bytes(rpc::kCredentialMax))));
}

}  // namespace
}  // namespace tandem::auth
