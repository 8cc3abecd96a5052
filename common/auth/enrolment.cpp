#include "common/auth/enrolment.h"

#include <algorithm>
#include <vector>

#include "common/auth/base32.h"
#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"

namespace tandem::auth {
namespace {

constexpr std::string_view kEnrolmentPrefix = "tandem:";
constexpr std::byte kVersion{1};
constexpr std::size_t kHead = 2, kPin = 32, kCode = 16, kCheck = 4;
constexpr std::size_t kSessionCode = 10;

bool printable(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

/// Holds a code while it is decoded, and wipes it.
struct Wiped {
  std::vector<std::byte> bytes;
  ~Wiped() { wipe(bytes); }
};

}  // namespace

CodeHash hash_of(const EnrolmentCode& code) noexcept {
  return transport::sha256(bytes_of("tandem enrolment code v1"), code.bytes);
}

std::string EnrolmentString::to_text() const {
  if (address.empty() || address.size() > kAddressMax || !printable(address)) return {};
  Wiped all;
  all.bytes.reserve(kHead + address.size() + kPin + kCode + kCheck);
  const auto add = [&all](std::span<const std::byte> bytes) {
    all.bytes.insert(all.bytes.end(), bytes.begin(), bytes.end());
  };
  all.bytes = {kVersion, static_cast<std::byte>(address.size())};
  all.bytes.reserve(kHead + address.size() + kPin + kCode + kCheck);
  add(bytes_of(address));
  add(server.sha256);
  add(code.bytes);
  const auto check = transport::sha256(all.bytes);
  add(std::span(check).first(kCheck));
  return std::string(kEnrolmentPrefix) + to_base32(all.bytes);
}

std::expected<EnrolmentString, std::string> EnrolmentString::from_text(std::string_view text) {
  std::string prefix(text.substr(0, kEnrolmentPrefix.size()));
  std::ranges::transform(prefix, prefix.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (prefix != kEnrolmentPrefix) return std::unexpected("begins with `tandem:`, as tandem-server enroll prints it");
  auto decoded = from_base32(text.substr(kEnrolmentPrefix.size()));
  if (!decoded) return std::unexpected("a character is wrong or missing; copy it again, whole");
  const Wiped all{std::move(*decoded)};
  const std::span<const std::byte> bytes = all.bytes;
  if (!bytes.empty() && bytes[0] != kVersion) return std::unexpected("is of another version of Tandem");
  const std::size_t length = bytes.size() < kHead ? 0 : std::to_integer<std::size_t>(bytes[1]);
  if (length == 0 || length > kAddressMax || bytes.size() != kHead + length + kPin + kCode + kCheck)
    return std::unexpected("has the wrong length; copy it again, whole");
  const auto check = transport::sha256(bytes.first(bytes.size() - kCheck));
  if (!std::ranges::equal(bytes.last(kCheck), std::span(check).first(kCheck)))
    return std::unexpected("has a wrong checksum: a character was changed; copy it again, whole");
  EnrolmentString out;
  out.address = text_of(bytes.subspan(kHead, length));
  if (!printable(out.address)) return std::unexpected("names an address that cannot be one");
  std::ranges::copy(bytes.subspan(kHead + length, kPin), out.server.sha256.begin());
  std::ranges::copy(bytes.subspan(kHead + length + kPin, kCode), out.code.bytes.begin());
  return out;
}

std::string session_code(std::span<const std::byte, 7> random) { return to_base32(random).substr(0, kSessionCode); }

std::optional<std::string> canonical_session_code(std::string_view typed) {
  if (typed.size() > 4 * kSessionCode) return std::nullopt;
  // Two more characters make whole bytes (56 bits of 60), so that the same decoder checks every character.
  const auto bytes = from_base32(std::string(typed) + "00");
  if (!bytes || bytes->size() != 7) return std::nullopt;
  std::string text = to_base32(*bytes).substr(0, kSessionCode);
  return text;
}

}  // namespace tandem::auth
