#include "netsim/app/mistakes.h"
#include "common/io/print.h"

#include <algorithm>
#include <cstdio>

namespace tandem::netsim {

void Mistakes::add(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end > 0) lines_.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

std::size_t Mistakes::count() const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(lines_, [](const std::string& line) { return !line.ends_with(':'); }));
}

int Mistakes::refuse(std::string_view command) const {
  for (const std::string& line : lines_)
    io::printf_for_people(stderr, "tandem-netsim %.*s: %s\n", static_cast<int>(command.size()), command.data(), line.c_str());
  io::printf_for_people(stderr, "%zu mistake%s; nothing was started\n", count(), count() == 1 ? "" : "s");
  return kWrong;
}

int refuse(std::string_view command, std::string_view text) {
  Mistakes mistakes;
  mistakes.add(text);
  return mistakes.refuse(command);
}

}  // namespace tandem::netsim
