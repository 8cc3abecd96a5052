// Tests that this code produces and opens the published vectors (vectors.json). second_decoder.mjs opens them too; it
// is written from FORMAT.md alone.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/transport/ratchet.h"

namespace tandem::transport {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

Bytes from_hex(const std::string& hex) {
  Bytes out;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    out.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return out;
}

TEST(Vectors, MatchThisImplementation) {
  std::ifstream file(TANDEM_SOURCE_DIR "/tests/common/transport/vectors.json");
  ASSERT_TRUE(file) << "tests/common/transport/vectors.json is missing";
  const Json vectors = Json::parse(file);
  ASSERT_GE(vectors["datagrams"].size(), 12U);
  for (const Json& v : vectors["datagrams"]) {
    SCOPED_TRACE(v["name"].get<std::string>());
    const bool aes = v["cipher"] == "AES-256-GCM";
    if (aes && fastest_cipher() != Cipher::kAes256Gcm) {
      std::printf("[ NOT RUN ] a vector with AES-256-GCM: this processor has no instructions for it\n");
      continue;
    }
    Secret secret;
    const Bytes first = from_hex(v["secret_0"]);
    std::copy_n(first.begin(), secret.bytes.size(), secret.bytes.begin());
    const auto phase = v["key_number"].get<std::uint64_t>();
    for (std::uint64_t n = 0; n < phase; ++n) secret = next_secret(secret);
    Aead seal{key_of(secret, aes ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305)};

    const Bytes plaintext = from_hex(v["plaintext"]), datagram = from_hex(v["datagram"]);
    const Header header{static_cast<wire::Type>(v["type"].get<int>()), static_cast<std::uint8_t>(phase & 0xff),
                        v["connection_id"].get<std::uint32_t>(), std::stoull(v["counter"].get<std::string>())};
    Bytes made(kHeaderSize);
    write_header(header, std::span(made).first<kHeaderSize>());
    made.insert(made.end(), plaintext.begin(), plaintext.end());
    made.resize(made.size() + kTagSize);
    ASSERT_TRUE(seal.seal(header.counter, made));
    EXPECT_EQ(made, datagram);
    Bytes opened(plaintext.size());
    ASSERT_TRUE(read_header(datagram));
    EXPECT_TRUE(seal.open(header.counter, datagram, opened));
    EXPECT_EQ(opened, plaintext);
  }
}

TEST(Vectors, OpenInAnIndependentDecoder) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "node is not installed (package nodejs)";
  const std::string folder = TANDEM_SOURCE_DIR "/tests/common/transport/";
  EXPECT_EQ(std::system(("node " + folder + "second_decoder.mjs " + folder + "vectors.json").c_str()), 0);
}

}  // namespace
}  // namespace tandem::transport
