#pragma once

#include <functional>
#include <string>

namespace tandem::server {

/// Runs `attempt` in a child process, a copy of this one, and returns its text. A library that crashes or does not end
/// on a damaged file then ends the child only. Standard error of the child is closed to users: `/dev/null`.
/// @param attempt        returns why it fails; empty: it succeeds
/// @param cpu_seconds    processor time after which the child is ended [s], at least 1
/// @return the text of `attempt`; or that the child crashed, ran out of memory or was ended, with the signal; or why no
/// child could be started
[[nodiscard]] std::string try_in_child(const std::function<std::string()>& attempt, unsigned cpu_seconds);

}  // namespace tandem::server
