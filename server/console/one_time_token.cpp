#include "server/console/one_time_token.h"

#include <utility>

namespace tandem::console {

bool equal_secrets(std::string_view a, std::string_view b) noexcept {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return different == 0;
}

bool OneTimeToken::redeem(std::string_view given, Time now) noexcept {
  if (secret_.empty() || now >= expires_ || !equal_secrets(secret_, given)) return false;
  secret_.clear();
  return true;
}

}  // namespace tandem::console
