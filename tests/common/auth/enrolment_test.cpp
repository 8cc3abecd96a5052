#include "common/auth/enrolment.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "common/auth/base32.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

EnrolmentString sample() {
  return {"lab-server:7000", KeyFingerprint{test::counting<32>(9)}, test::secret_from<16>(1)};
}

TEST(EnrolmentCode, Is26Characters) { EXPECT_EQ(to_base32(test::secret_from<16>(1).bytes).size(), 26u); }

TEST(EnrolmentCode, HasAnotherHashAfterAOneBitChange) {
  const auto right = test::secret_from<16>(1);
  std::set<CodeHash> hashes{hash_of(right)};
  for (std::size_t bit = 0; bit < 128; ++bit) {
    auto wrong = right;
    wrong.bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    hashes.insert(hash_of(wrong));
  }
  EXPECT_EQ(hashes.size(), 129u);
}

TEST(EnrolmentString, IsReadBackInEitherCaseAndWithDashes) {
  const std::string text = sample().to_text();
  std::string lower = text;
  for (char& c : lower) c = static_cast<char>(std::tolower(c));
  for (const std::string& form : {text, lower, "tandem:" + grouped(text.substr(7), 5)}) {
    const auto got = EnrolmentString::from_text(form);
    ASSERT_TRUE(got) << got.error();
    EXPECT_EQ(got->address, "lab-server:7000");
    EXPECT_EQ(got->server, sample().server);
    EXPECT_EQ(got->code, sample().code);
  }
}

TEST(EnrolmentString, DetectsAnyWrongCharacter) {
  const std::string text = sample().to_text();
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string wrong = text;
    wrong[i] = text[i] == 'Z' ? 'Y' : 'Z';
    const auto got = EnrolmentString::from_text(wrong);
    ASSERT_FALSE(got) << i;
    EXPECT_EQ(got.error().find(text.substr(20, 12)), std::string::npos) << "the message must not repeat the secret";
  }
  for (std::size_t cut = 0; cut < text.size(); ++cut) EXPECT_FALSE(EnrolmentString::from_text(text.substr(0, cut)));
  EXPECT_FALSE(EnrolmentString::from_text(text + "00"));
}

TEST(EnrolmentString, RejectsInvalidAddresses) {
  EnrolmentString e = sample();
  for (const std::string& bad : {std::string(), std::string(97, 'a'), std::string("a b:1"), std::string("a\n:1")}) {
    e.address = bad;
    EXPECT_EQ(e.to_text(), "");
  }
  e.address = std::string(96, 'a');
  ASSERT_TRUE(EnrolmentString::from_text(e.to_text()));
}

TEST(SessionCode, Is10CharactersAndToleratesTypingVariants) {
  const std::string code = session_code(test::counting<7>(200));
  EXPECT_EQ(code.size(), 10u);
  EXPECT_EQ(canonical_session_code(code), code);
  EXPECT_EQ(canonical_session_code(grouped(code, 5)), code);
  EXPECT_EQ(canonical_session_code("OIL0000000"), "0110000000");
  EXPECT_FALSE(canonical_session_code(code + "0"));
  EXPECT_FALSE(canonical_session_code(code.substr(1)));
  EXPECT_FALSE(canonical_session_code("U000000000"));
  EXPECT_FALSE(canonical_session_code(""));
  EXPECT_FALSE(canonical_session_code(std::string(1000, '-')));
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {  // every possible code can be typed
    std::string any;
    for (int k = 0; k < 10; ++k) any += "0123456789ABCDEFGHJKMNPQRSTVWXYZ"[random.below(32)];
    EXPECT_EQ(canonical_session_code(any), any);
  }
}

}  // namespace
}  // namespace tandem::auth
