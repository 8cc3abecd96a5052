#include "common/transport/aead.h"

#include <gtest/gtest.h>
#include <openssl/evp.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/base/rng.h"
#include "tests/common/transport/secure_channel_pair.h"
#include "tests/support/alloc_guard.h"

namespace tandem::transport {
namespace {

std::vector<std::byte> from_hex(std::string_view hex) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::vector<std::byte> out;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    out.push_back(static_cast<std::byte>(16 * digit(hex[i]) + digit(hex[i + 1])));
  return out;
}

Key known_key(std::string_view key, std::string_view iv) {
  Key k;
  k.cipher = Cipher::kAes256Gcm;
  std::ranges::copy(from_hex(key), k.key.bytes.begin());
  std::ranges::copy(from_hex(iv), k.iv.bytes.begin());
  return k;
}

Key some_key() { return key_of(test::secrets(1).to_server, fastest_cipher()); }

/// Independent test vector for AES-256-GCM; AAD = 16 bytes, the size of our header.
struct Known {
  std::string_view key, nonce, header, plaintext, sealed;
};
/// First: NIST CAVP gcmEncryptExtIV256, 128-bit AAD, count 0. The others: python-cryptography 48, lengths 1, 77, 300.
constexpr Known kKnown[] = {
    {"92e11dcdaa866f5ce790fd24501f92509aacf4cb8b1339d50c9c1240935dd08b", "ac93a1a6145299bde902f21a",
     "1e0889016f67601c8ebea4943bc23ad6", "2d71bcfa914e4ac045b2aa60955fad24",
     "8995ae2e6df3dbf96fac7b7137bae67feca5aa77d51d4a0a14d9c51e1da474ab"},
    {"d1a5ac9a015fac2ef7b341673635512a1511f41fe37d111b267f039eec5d4f58", "820d5d8baf762ec66dcd56fe",
     "4e1195df020de59e0d65a33a4279f118", "16", "22f32eb9d7ca925cdb8278b0b8ef0d7025"},
    {"6ab9f1eb8f7d3388f4f9d586f66e99fd54080df2c446f0e58668b09c08a16dd0", "676b8bb84ce7267dd520deca",
     "f55ff16f66f43360266b95db6f8fec01",
     "f64551fcd6f07823cb87971cfb91446425da18286b3ab1ef935e0cbd7a69f68af64551fcd6f07823cb87971cfb914464"
     "25da18286b3ab1ef935e0cbd7a69f68af64551fcd6f07823cb87971cfb",
     "d295fdf69beeb8742b210e58f9b982982bed19b93f9f4392ed217ae4f56a019d6288c44ca99a20169d1ba71d545d8545"
     "551106fcd5bc16904adf2f8c1dc4912df561684566ba92a27d8282066afd35147b626dc03eec43a7af4f2ec56e"},
    {"015f7e6bc5aeaf483724089e9252cc13b50951a6b69412522765cff4d780306e", "0480a93d2e9b094b89e08e01",
     "2c3a4249d77070058649dbd822dcaf79",
     "3946ca64ff78d93ca61090a437cbb6b3d2ca0d488f5f9ccf3059608368b276933946ca64ff78d93ca61090a437cbb6b3"
     "d2ca0d488f5f9ccf3059608368b276933946ca64ff78d93ca61090a437cbb6b3d2ca0d488f5f9ccf3059608368b27693"
     "3946ca64ff78d93ca61090a437cbb6b3d2ca0d488f5f9ccf3059608368b276933946ca64ff78d93ca61090a437cbb6b3"
     "d2ca0d488f5f9ccf3059608368b276933946ca64ff78d93ca61090a437cbb6b3d2ca0d488f5f9ccf3059608368b27693"
     "3946ca64ff78d93ca61090a437cbb6b3d2ca0d488f5f9ccf3059608368b276933946ca64ff78d93ca61090a437cbb6b3"
     "d2ca0d488f5f9ccf3059608368b276933946ca64ff78d93ca61090a437cbb6b3d2ca0d488f5f9ccf3059608368b27693"
     "3946ca64ff78d93ca61090a4",
     "a63c99bff7ced6a132d6ed4d390fbc87aa058d4be88c96c9c8f196631de944689cf2514966d50e01babe8447607dd614"
     "8cc0665b66ef016f58f37f456ad26f2e24be745ed63b00d33acc549c8c57adc4a75d96455b5d027b2dc8b75f95e2e1e8"
     "71ba1b54060defcec5273bc2e2dd09f6031ba2536a4b45a5117056f2919bc683075d9b1c43fa053dfd9b4fd8a8de8a90"
     "d62a2205fe52c247c36f778d9b0a38553e9641204a3c6c9d1a1a9aca9237abb51aee4b71121fd09a91d3000c89e814a4"
     "637766d63d1ab55a8efa5b37279f5234625b556608495306d7e39ae65985379aacda4b9ccbfd4e3ddd3a674a1e87ad26"
     "09c21b58bd42d88d1dddd3aa36de65ed0b64ebb4a9cb3dccc9cf51c0f1f0e67b38fd3e9b333c87471d1039fd129d06de"
     "ae8622d3faa4d0da7657eec9de778bbef70a039cdb84dc06629281b0"},
};

std::vector<std::byte> datagram_of(const Known& k) {
  auto d = from_hex(k.header);
  const auto p = from_hex(k.plaintext);
  d.insert(d.end(), p.begin(), p.end());
  d.resize(d.size() + kTagSize);
  return d;
}

constexpr const char* kNoAes = "AES-256-GCM: this processor has no instructions for it";

TEST(Aead, IsAes256GcmWithTheHeaderAuthenticated) {
  if (fastest_cipher() != Cipher::kAes256Gcm) GTEST_SKIP() << kNoAes;
  for (const Known& k : kKnown) {
    auto d = datagram_of(k);
    Aead seal(known_key(k.key, k.nonce));
    ASSERT_TRUE(seal.seal(0, d));
    EXPECT_EQ(std::vector(d.begin() + 16, d.end()), from_hex(k.sealed));
    EXPECT_EQ(std::vector(d.begin(), d.begin() + 16), from_hex(k.header));
  }
}

TEST(Aead, MixesTheCounterIntoTheLastEightBytesOfTheNonce) {  // little-endian
  if (fastest_cipher() != Cipher::kAes256Gcm) GTEST_SKIP() << kNoAes;
  const Known& k = kKnown[0];
  auto iv = from_hex(k.nonce);
  constexpr std::uint64_t kCounter = 0x0102030405060708;
  for (std::size_t i = 0; i < 8; ++i) iv[4 + i] ^= static_cast<std::byte>(8 - i);
  Key key = known_key(k.key, k.nonce);
  std::ranges::copy(iv, key.iv.bytes.begin());
  auto d = datagram_of(k);
  Aead seal(key);
  ASSERT_TRUE(seal.seal(kCounter, d));
  EXPECT_EQ(std::vector(d.begin() + 16, d.end()), from_hex(k.sealed));
}

/// Returns the datagram as OpenSSL seals it: header | ciphertext | tag.
std::vector<std::byte> by_openssl(const Key& key, std::span<const std::byte, 12> nonce, std::vector<std::byte> d) {
  const auto raw = [](const std::byte* p) { return reinterpret_cast<const unsigned char*>(p); };
  const auto out = [](std::byte* p) { return reinterpret_cast<unsigned char*>(p); };
  const std::unique_ptr<EVP_CIPHER_CTX, decltype(&EVP_CIPHER_CTX_free)> c{EVP_CIPHER_CTX_new(), &EVP_CIPHER_CTX_free};
  const EVP_CIPHER* cipher = key.cipher == Cipher::kAes256Gcm ? EVP_aes_256_gcm() : EVP_chacha20_poly1305();
  std::byte* body = d.data() + kHeaderSize;
  const int size = static_cast<int>(d.size() - kHeaderSize - kTagSize);
  int n = 0;
  EXPECT_EQ(EVP_EncryptInit_ex(c.get(), cipher, nullptr, raw(key.key.bytes.data()), raw(nonce.data())), 1);
  EXPECT_EQ(EVP_EncryptUpdate(c.get(), nullptr, &n, raw(d.data()), static_cast<int>(kHeaderSize)), 1);
  EXPECT_EQ(EVP_EncryptUpdate(c.get(), out(body), &n, raw(body), size), 1);
  EXPECT_EQ(EVP_EncryptFinal_ex(c.get(), out(body + size), &n), 1);
  EXPECT_EQ(EVP_CIPHER_CTX_ctrl(c.get(), EVP_CTRL_AEAD_GET_TAG, static_cast<int>(kTagSize), out(body + size)), 1);
  return d;
}

TEST(Aead, MatchesAnotherLibraryByteForByte) {
  std::vector<Cipher> ciphers{Cipher::kChaCha20Poly1305};
  if (fastest_cipher() == Cipher::kAes256Gcm) ciphers.push_back(Cipher::kAes256Gcm);
  for (const Cipher cipher : ciphers) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      RandomStream random{RandomKey{seed}.derive(17)};
      const auto fill = [&](auto& bytes) {
        for (auto& b : bytes) b = static_cast<std::byte>(random.below(256));
      };
      Key key;
      key.cipher = cipher;
      fill(key.key.bytes);
      fill(key.iv.bytes);
      std::vector<std::byte> plain(random.below(1400)), d(kHeaderSize + plain.size() + kTagSize);
      fill(d);
      std::copy_n(d.begin() + kHeaderSize, plain.size(), plain.begin());
      const auto clear = d;
      ASSERT_TRUE(Aead(key).seal(0, d));
      ASSERT_EQ(d, by_openssl(key, key.iv.bytes, clear));
      std::vector<std::byte> opened(plain.size());
      ASSERT_TRUE(Aead(key).open(0, d, opened));
      EXPECT_EQ(opened, plain);
      d[random.below(d.size())] ^= static_cast<std::byte>(1U << random.below(8));
      EXPECT_FALSE(Aead(key).open(0, d, opened));
    }
  }
}

TEST(Aead, OpensOnlyUnderTheSameSecretAndCounter) {
  std::vector<std::byte> d(100, std::byte{42}), plain(100 - 32);
  const ConnectionSecrets a = test::secrets(7), b = test::secrets(8);
  Aead sealing(key_of(a.to_server, a.cipher));
  ASSERT_TRUE(sealing.seal(3, d));
  const auto opens = [&](const Secret& secret, std::uint64_t counter) {
    return Aead(key_of(secret, a.cipher)).open(counter, d, plain);
  };
  EXPECT_TRUE(opens(a.to_server, 3));
  EXPECT_EQ(plain, std::vector(68, std::byte{42}));
  EXPECT_FALSE(opens(b.to_server, 3));
  EXPECT_FALSE(opens(a.to_client, 3));
  EXPECT_FALSE(opens(next_secret(a.to_server), 3));
  EXPECT_FALSE(opens(a.to_server, 4));
  EXPECT_FALSE(opens(a.to_server, 3 + (std::uint64_t{1} << 56)));
}

TEST(Aead, ContinuesAfterAForgery) {
  Aead sealing(some_key());
  Aead opening(some_key());
  std::vector<std::byte> d(64), plain(32);
  ASSERT_TRUE(sealing.seal(0, d));
  auto forged = d;
  forged[40] ^= std::byte{1};
  EXPECT_FALSE(opening.open(0, forged, plain));
  EXPECT_TRUE(opening.open(0, d, plain));
}

// A cipher that decrypts and authenticates in one pass wipes its output.
TEST(Aead, ReleasesNoPlaintextOfAForgery) {
  for (const Cipher cipher : {fastest_cipher(), Cipher::kChaCha20Poly1305}) {
    const Key key = key_of(test::secrets(1).to_server, cipher);
    for (const std::size_t size : {1U, 15U, 16U, 17U, 128U, 295U, 1168U}) {
      std::vector<std::byte> d(kHeaderSize + size + kTagSize, std::byte{42}), plain(size);
      ASSERT_TRUE(Aead(key).seal(7, d));
      d.back() ^= std::byte{0x80};
      std::ranges::fill(plain, std::byte{0});
      EXPECT_FALSE(Aead(key).open(7, d, plain));
      EXPECT_EQ(plain, std::vector<std::byte>(size));
    }
  }
}

TEST(Aead, RejectsImpossibleSizes) {
  Aead sealing(some_key());
  Aead opening(some_key());
  std::vector<std::byte> d(64), plain(32);
  EXPECT_FALSE(sealing.seal(0, std::span(d).first(31)));
  EXPECT_FALSE(opening.open(0, std::span(d).first(31), plain));
  EXPECT_FALSE(opening.open(0, d, std::span(plain).first(31)));
}

TEST(Aead, WorksWithoutHeap) {
  Aead sealing(some_key());
  Aead opening(some_key());
  std::vector<std::byte> d(200), plain(168);
  const tandem::test::AllocGuard guard;
  for (std::uint64_t c = 0; c < 1000; ++c) {
    ASSERT_TRUE(sealing.seal(c, d));
    ASSERT_TRUE(opening.open(c, d, plain));
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::transport
