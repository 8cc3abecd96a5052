#include "netsim/app/interruption.h"

#include <poll.h>

#include <cstdio>

#include "common/io/print.h"
#include "common/io/signals.h"

namespace tandem::netsim {

Interruption::Interruption() : signals_(io::signals_as_file()) {}

bool Interruption::came() const noexcept {
  pollfd waiting{signals_.get(), POLLIN, 0};
  return ::poll(&waiting, 1, 0) > 0;
}

void Interruption::say(std::string_view command, const std::string& done) {
  const std::string_view by = io::signal_that_came();
  io::printf_for_people(stderr, "tandem-netsim %.*s: interrupted after %s%s%.*s. What was done so far is told and is no pass\n",
               static_cast<int>(command.size()), command.data(), done.c_str(), by.empty() ? "" : " by ",
               static_cast<int>(by.size()), by.data());
}

}  // namespace tandem::netsim
