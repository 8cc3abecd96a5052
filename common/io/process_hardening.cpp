#include "common/io/process_hardening.h"

#include <sys/prctl.h>
#include <sys/resource.h>

namespace tandem::io {

bool disable_core_dumps() noexcept {
  const rlimit none{0, 0};
  const bool no_core = setrlimit(RLIMIT_CORE, &none) == 0;
  return prctl(PR_SET_DUMPABLE, 0UL, 0UL, 0UL, 0UL) == 0 && no_core;
}

bool harden_process() noexcept {
#ifdef TANDEM_DEBUG
  return false;
#else
  return disable_core_dumps();
#endif
}

}  // namespace tandem::io
