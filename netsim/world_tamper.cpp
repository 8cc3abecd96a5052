#include "netsim/world_tamper.h"

#include <algorithm>
#include <limits>

namespace tandem::netsim {

namespace {
/// For so many lies on end a liar says that its hand is stopped, then as many that it is not.
constexpr std::uint64_t kStopLies = 700;
}  // namespace

void WorldTamper::remember(Direction direction, std::span<const std::byte> datagram) noexcept {
  const auto d = static_cast<std::size_t>(direction);
  Kept& place = kept_[d][count_[d]++ % kRemembered];
  place.size = std::min(datagram.size(), place.bytes.size());
  std::copy_n(datagram.begin(), place.size, place.bytes.begin());
}

std::span<const std::byte> WorldTamper::again(Direction direction) noexcept {
  const auto d = static_cast<std::size_t>(direction);
  const std::uint64_t known = std::min<std::uint64_t>(count_[d], kRemembered);
  if (known == 0) return {};
  const Kept& chosen = kept_[d][key_.bits(draws_++) % known];
  return std::span{chosen.bytes}.first(chosen.size);
}

std::span<const std::byte> WorldTamper::junk(std::uint32_t cid) noexcept {
  const std::uint64_t drawn = key_.bits(draws_++);
  const std::size_t size = drawn % (junk_.size() + 1);
  for (std::size_t i = 0; i < size; i += 8) {
    const std::uint64_t word = key_.bits(draws_++);
    for (std::size_t j = i; j < std::min(size, i + 8); ++j) junk_[j] = static_cast<std::byte>(word >> (8 * (j - i)));
  }
  if (drawn >> 63 != 0 && size >= link::kHeaderSize) {
    const auto type = static_cast<wire::Type>(1 + (drawn >> 32) % 9);
    link::write_header({type, 0, cid, drawn >> 8}, std::span{junk_}.first<link::kHeaderSize>());
  }
  return std::span{junk_}.first(size);
}

void WorldTamper::joined(std::uint32_t cid, const link::ConnectionSecrets& secrets) {
  keys_.emplace(Keys{cid, secrets.cipher, secrets.to_server, 0, link::Seal(link::key_of(secrets.to_server, secrets.cipher))});
}

std::optional<wire::Received<wire::StateMessage>> WorldTamper::opened(std::uint32_t cid, std::span<const std::byte> datagram) noexcept {
  const auto header = link::read_header(datagram);
  if (!header || header->type != wire::Type::kState || header->cid != cid) return std::nullopt;
  if (!keys_ || keys_->cid != cid) return std::nullopt;
  while (keys_->phase != header->key_phase) {
    keys_->secret = link::next_secret(keys_->secret);
    keys_->seal.rekey(link::key_of(keys_->secret, keys_->cipher));
    ++keys_->phase;
  }
  std::array<std::byte, link::kDatagramMax> plain;
  const std::span<std::byte> plaintext{plain.data(), datagram.size() - link::kHeaderSize - link::kTagSize};
  if (!keys_->seal.open(header->counter, datagram, plaintext)) return std::nullopt;
  const auto decoded = codec_.decode_state(plaintext);
  return decoded ? std::optional{*decoded} : std::nullopt;
}

void WorldTamper::lie(std::uint32_t cid, std::span<std::byte> datagram) noexcept {
  auto state = opened(cid, datagram);
  if (!state) return;
  for (std::uint64_t& e : state->message.port.e_in) e = static_cast<std::uint64_t>(static_cast<double>(e) * key_.uniform(draws_));
  ++draws_;
  state->message.stop = lies_++ / kStopLies % 2 == 0;
  static_cast<void>(codec_.encode(state->preamble, state->message, datagram.subspan(link::kHeaderSize)));
  static_cast<void>(keys_->seal.seal(link::read_header(datagram)->counter, datagram));
}

std::span<const std::byte> WorldTamper::attack(std::uint32_t cid, std::span<std::byte> datagram, std::uint32_t stops) noexcept {
  auto state = opened(cid, datagram);
  if (!state) return datagram;
  auto header = *link::read_header(datagram);
  const auto body = datagram.subspan(link::kHeaderSize);
  const std::uint64_t drawn = key_.bits(draws_++);
  std::size_t plain = datagram.size() - link::kHeaderSize - link::kTagSize;
  constexpr double kWrong[] = {1e308, 100, std::numeric_limits<double>::quiet_NaN(), 5};
  switch (drawn % 7) {
    case 4: {
      header.type = wire::Type::kAuthority;
      wire::AuthorityMessage grab{.version = static_cast<std::uint32_t>(drawn >> 8) % 8 + 1, .tool = 0, .masters = masters_, .alpha = {}};
      grab.alpha[own_] = 1;
      plain = codec_.encode(state->preamble, grab, body);
      break;
    }
    case 5: plain -= 1 + (drawn >> 8) % 16; break;
    case 6:
      state->message.resume_stop = stops;
      static_cast<void>(codec_.encode(state->preamble, state->message, body));
      break;
    default:
      state->message.port.x[0] = kWrong[drawn % 7];
      static_cast<void>(codec_.encode(state->preamble, state->message, body));
      break;
  }
  link::write_header(header, datagram.first<link::kHeaderSize>());
  const auto out = datagram.first(link::kHeaderSize + plain + link::kTagSize);
  static_cast<void>(keys_->seal.seal(header.counter, out));
  return out;
}

}  // namespace tandem::netsim
