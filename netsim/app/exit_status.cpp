#include "netsim/app/exit_status.h"

#include "common/io/exit_code.h"
#include "common/io/print.h"

namespace tandem::netsim {

int exit_status(std::string_view command, std::initializer_list<std::string> problems, bool good) {
  for (const std::string& problem : problems) {
    if (problem.empty()) continue;
    io::print(stderr, std::string(command) + ": " + problem + "\n");
    good = false;
  }
  return good ? io::kExitDone : io::kExitTrouble;
}

}  // namespace tandem::netsim
