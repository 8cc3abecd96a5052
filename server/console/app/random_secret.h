#pragma once

#include <openssl/rand.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "common/base/hex.h"

namespace tandem::console {

/// Returns 32 random bytes as hexadecimal digits, for tokens and cookies.
/// @throws std::runtime_error if the system gives no random numbers
[[nodiscard]] inline std::string random_secret() {
  std::array<std::byte, 32> bytes;
  if (RAND_bytes(reinterpret_cast<unsigned char*>(bytes.data()), static_cast<int>(bytes.size())) != 1)
    throw std::runtime_error("the system gives no random numbers");
  return to_hex(bytes);
}

}  // namespace tandem::console
