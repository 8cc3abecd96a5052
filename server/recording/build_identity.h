#pragma once

#include <string_view>

namespace tandem::server {

/// Sources that this program was built from.
struct BuildIdentity {
  std::string_view version;  ///< of the project
  std::string_view commit;   ///< first 12 digits of the git commit; `unknown` outside a repository
};
[[nodiscard]] BuildIdentity build_identity() noexcept;

}  // namespace tandem::server
