#include "netsim/replay/replay_keys.h"

#include <algorithm>

#include "common/base/rng.h"

namespace tandem::netsim {
namespace {

transport::Secret made_secret(RandomKey key) noexcept {
  transport::Secret secret;
  for (std::size_t i = 0; i < secret.bytes.size(); ++i)
    secret.bytes[i] = static_cast<std::byte>(key.bits(i) & 0xff);
  return secret;
}

}  // namespace

ReplayKeys::ReplayKeys(std::uint64_t number)
    : secrets_{.cipher = transport::fastest_cipher(),
               .to_server = made_secret(RandomKey{number}.derive(1)),
               .to_client = made_secret(RandomKey{number}.derive(2))},
      last_(secrets_.to_server) {
  keys_.emplace_back(transport::key_of(last_, secrets_.cipher));
}

std::span<const std::byte> ReplayKeys::seal(const JournalDatagram& recorded, std::uint32_t own_cid,
                                            std::uint64_t phase) {
  const auto ahead = static_cast<std::uint8_t>(recorded.key_phase - static_cast<std::uint8_t>(phase & 0xff));
  if (ahead > 1 && !(ahead == 0xff && phase > 0)) return {};
  const std::uint64_t wanted = ahead == 0xff ? phase - 1 : phase + ahead;
  while (keys_.size() <= wanted) {
    last_ = transport::next_secret(last_);
    keys_.emplace_back(transport::key_of(last_, secrets_.cipher));
  }
  const auto bytes =
      std::span{datagram_}.first(transport::kHeaderSize + recorded.plaintext.size() + transport::kTagSize);
  transport::write_header({recorded.type, recorded.key_phase, own_cid, recorded.counter},
                          bytes.first<transport::kHeaderSize>());
  std::ranges::copy(recorded.plaintext, bytes.begin() + transport::kHeaderSize);
  if (!keys_[wanted].seal(recorded.counter, bytes)) return {};
  return bytes;
}

}  // namespace tandem::netsim
