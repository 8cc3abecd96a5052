#include "common/transport/digest.h"

#include <gtest/gtest.h>

namespace tandem::transport {
namespace {

std::string sha256(std::string_view text) {
  Digest d;
  d.add(text);
  return d.hex();
}

TEST(Digest, IsSha256) {  // FIPS 180-2, appendix B
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, IsIndependentOfHowTheInputIsSplit) {
  Digest pieces;
  pieces.add("a");
  pieces.add("");
  Digest moved = std::move(pieces);
  moved.add("bc");
  EXPECT_EQ(moved.hex(), sha256("abc"));
}

}  // namespace
}  // namespace tandem::transport
