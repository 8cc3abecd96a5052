#include "netsim/app/usage_errors.h"

#include <algorithm>
#include <cstdio>

#include "common/io/print.h"

namespace tandem::netsim {

void UsageErrors::add(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end > 0) lines_.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

std::size_t UsageErrors::count() const noexcept {
  return static_cast<std::size_t>(
      std::ranges::count_if(lines_, [](const std::string& line) { return !line.ends_with(':'); }));
}

int UsageErrors::report(std::string_view command) const {
  for (const std::string& line : lines_)
    io::print_formatted(stderr, "tandem-netsim %.*s: %s\n", static_cast<int>(command.size()), command.data(),
                        line.c_str());
  io::print_formatted(stderr, "%zu mistake%s; nothing was started\n", count(), count() == 1 ? "" : "s");
  return kUsageError;
}

int report_usage_error(std::string_view command, std::string_view text) {
  UsageErrors mistakes;
  mistakes.add(text);
  return mistakes.report(command);
}

}  // namespace tandem::netsim
