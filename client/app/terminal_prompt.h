#pragma once

#include <string>

/// Questions to the user at the terminal, on standard error; answers from standard input.
namespace tandem::client {

/// Shows `words` and blocks until the user presses Enter.
/// @param signals  signalfd (common/io/signals.h)
/// @return false if a signal arrived, which stays pending, or if standard input ended
[[nodiscard]] bool wait_for_enter(const std::string& words, int signals);

/// Shows `words` and waits for a line. @return true for `yes`; false for any other word, a signal, or the end of input
[[nodiscard]] bool user_confirms(const std::string& words, int signals);

}  // namespace tandem::client
