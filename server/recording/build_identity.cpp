#include "server/recording/build_identity.h"

namespace tandem::server {

BuildIdentity build_identity() noexcept {
  return {
#include "build_identity.inc"
  };
}

}  // namespace tandem::server
