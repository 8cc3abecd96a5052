#include "netsim/system/attacker.h"

#include <algorithm>
#include <limits>

namespace tandem::netsim {

namespace {
/// Number of consecutive forged messages that claim a stopped hand; the same number without that claim follows.
constexpr std::uint64_t kStopLies = 700;
}  // namespace

void Attacker::remember(Direction direction, std::span<const std::byte> datagram) noexcept {
  const auto d = static_cast<std::size_t>(direction);
  KeptDatagram& place = kept_[d][count_[d]++ % kRemembered];
  place.size = std::min(datagram.size(), place.bytes.size());
  std::copy_n(datagram.begin(), place.size, place.bytes.begin());
}

std::span<const std::byte> Attacker::replayed(Direction direction) noexcept {
  const auto d = static_cast<std::size_t>(direction);
  const std::uint64_t known = std::min<std::uint64_t>(count_[d], kRemembered);
  if (known == 0) return {};
  const KeptDatagram& chosen = kept_[d][key_.bits(draws_++) % known];
  return std::span{chosen.bytes}.first(chosen.size);
}

std::span<const std::byte> Attacker::random_bytes(std::uint32_t cid) noexcept {
  const std::uint64_t drawn = key_.bits(draws_++);
  const std::size_t size = drawn % (random_bytes_.size() + 1);
  for (std::size_t i = 0; i < size; i += 8) {
    const std::uint64_t word = key_.bits(draws_++);
    for (std::size_t j = i; j < std::min(size, i + 8); ++j)
      random_bytes_[j] = static_cast<std::byte>(word >> (8 * (j - i)));
  }
  if (drawn >> 63 != 0 && size >= transport::kHeaderSize) {
    const auto type = static_cast<wire::Type>(1 + (drawn >> 32) % wire::kLastType);
    transport::write_header({type, 0, cid, drawn >> 8}, std::span{random_bytes_}.first<transport::kHeaderSize>());
  }
  return std::span{random_bytes_}.first(size);
}

void Attacker::set_connection(std::uint32_t cid, const transport::ConnectionSecrets& secrets) {
  keys_.emplace(Keys{cid, secrets.cipher, secrets.to_server, 0,
                     transport::Aead(transport::key_of(secrets.to_server, secrets.cipher))});
}

std::optional<wire::Received<wire::StateMessage>> Attacker::decrypt(std::uint32_t cid,
                                                                    std::span<const std::byte> datagram) noexcept {
  const auto header = transport::read_header(datagram);
  if (!header || header->type != wire::Type::kState || header->cid != cid) return std::nullopt;
  if (!keys_ || keys_->cid != cid) return std::nullopt;
  while (keys_->phase != header->key_phase) {
    keys_->secret = transport::next_secret(keys_->secret);
    keys_->seal.rekey(transport::key_of(keys_->secret, keys_->cipher));
    ++keys_->phase;
  }
  std::array<std::byte, transport::kDatagramMax> plain;
  const std::span<std::byte> plaintext{plain.data(), datagram.size() - transport::kHeaderSize - transport::kTagSize};
  if (!keys_->seal.open(header->counter, datagram, plaintext)) return std::nullopt;
  const auto decoded = codec_.decode_state(plaintext);
  return decoded ? std::optional{*decoded} : std::nullopt;
}

void Attacker::forge_energy_account(std::uint32_t cid, std::span<std::byte> datagram) noexcept {
  auto state = decrypt(cid, datagram);
  if (!state) return;
  for (std::uint64_t& e : state->message.port.e_in)
    e = static_cast<std::uint64_t>(static_cast<double>(e) * key_.uniform(draws_));
  ++draws_;
  state->message.stop = forged_++ / kStopLies % 2 == 0;
  static_cast<void>(codec_.encode(state->preamble, state->message, datagram.subspan(transport::kHeaderSize)));
  static_cast<void>(keys_->seal.seal(transport::read_header(datagram)->counter, datagram));
}

std::span<const std::byte> Attacker::forge_state(std::uint32_t cid, std::span<std::byte> datagram,
                                                 std::uint32_t stops) noexcept {
  auto state = decrypt(cid, datagram);
  if (!state) return datagram;
  auto header = *transport::read_header(datagram);
  const auto body = datagram.subspan(transport::kHeaderSize);
  const std::uint64_t drawn = key_.bits(draws_++);
  std::size_t plain = datagram.size() - transport::kHeaderSize - transport::kTagSize;
  constexpr double kWrong[] = {1e308, 100, std::numeric_limits<double>::quiet_NaN(), 5};
  switch (drawn % 7) {
    case 4: {
      header.type = wire::Type::kAuthority;
      wire::AuthorityMessage grab{
          .version = static_cast<std::uint32_t>(drawn >> 8) % 8 + 1, .tool = 0, .masters = masters_, .alpha = {}};
      grab.alpha[seat_index_] = 1;
      plain = codec_.encode(state->preamble, grab, body);
      break;
    }
    case 5:
      plain -= 1 + (drawn >> 8) % 16;
      break;
    case 6:
      state->message.resume_stop = stops;
      static_cast<void>(codec_.encode(state->preamble, state->message, body));
      break;
    default:
      state->message.port.x[0] = kWrong[drawn % 7];
      static_cast<void>(codec_.encode(state->preamble, state->message, body));
      break;
  }
  transport::write_header(header, datagram.first<transport::kHeaderSize>());
  const auto out = datagram.first(transport::kHeaderSize + plain + transport::kTagSize);
  static_cast<void>(keys_->seal.seal(header.counter, out));
  return out;
}

}  // namespace tandem::netsim
