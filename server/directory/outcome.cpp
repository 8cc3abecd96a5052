#include "server/directory/directory.h"

namespace tandem::directory {

const char* to_text(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kDone:
      return "done";
    case Outcome::kUnknown:
      return "no answer";
    case Outcome::kNoLease:
      return "the lease has ended";
    case Outcome::kCompacted:
      return "the revision has been compacted";
    case Outcome::kRefused:
      return "refused";
  }
  return "?";
}

}  // namespace tandem::directory
