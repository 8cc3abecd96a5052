#include "server/session/build_text.h"

#include "server/session/source_digest.inc"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

#if defined(__x86_64__)
#define TANDEM_PROCESSOR "x86_64"
#elif defined(__aarch64__)
#define TANDEM_PROCESSOR "aarch64"
#else
#define TANDEM_PROCESSOR "other"
#endif
#ifdef __OPTIMIZE__
#define TANDEM_OPTIMIZED "optimised"
#else
#define TANDEM_OPTIMIZED "not optimised"
#endif

namespace tandem::server {

std::string_view build_text() noexcept {
  return TANDEM_VERSION " sources " TANDEM_SOURCE_DIGEST ", compiler " __VERSION__ ", " TANDEM_PROCESSOR
                        ", " TANDEM_OPTIMIZED;
}

}  // namespace tandem::server
