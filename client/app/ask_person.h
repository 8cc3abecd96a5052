#pragma once

#include <string>

/// Questions to the person at the terminal, on standard error; answers from standard input.
namespace tandem::client {

/// Shows `words` and waits for Enter.
/// @param signals  file of signals.h
/// @return false: a signal came (it stays to be read), or nobody is there to press it
[[nodiscard]] bool wait_for_enter(const std::string& words, int signals);

/// Shows `words` and waits for a line. @return whether it is `yes`; any other word, a signal, or nobody there is no
[[nodiscard]] bool person_agrees(const std::string& words, int signals);

}  // namespace tandem::client
