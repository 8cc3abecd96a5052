#pragma once

#include <cctype>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tandem::bench {

/// Number of sessions that a program serves under callgrind.
inline constexpr std::size_t kSessions = 8;

/// User-space instructions inside one function and what it calls, by the library that executed them.
struct Instructions {
  double all = 0;
  double cipher = 0;  ///< libipsec-mb and libsodium
  double copy = 0;    ///< memcpy, memmove and memset of the C library
  [[nodiscard]] double rest() const { return all - cipher - copy; }
  [[nodiscard]] Instructions operator-(const Instructions& o) const {
    return {all - o.all, cipher - o.cipher, copy - o.copy};
  }
  [[nodiscard]] Instructions operator/(double n) const { return {all / n, cipher / n, copy / n}; }
};

/// Reads a file that callgrind wrote with --compress-strings=no --compress-pos=no. A cost line is "line cost". The line
/// after "calls=" gives the cost of the called function, which is listed as its own.
inline Instructions read_callgrind(std::istream& file) {
  Instructions sum;
  std::string line;
  bool cipher = false, copy = false, called = false;
  while (std::getline(file, line)) {
    const auto says = [&](std::string_view word) { return line.find(word) != std::string::npos; };
    if (line.starts_with("ob=")) {
      cipher = says("libIPSec_MB") || says("libsodium");
    } else if (line.starts_with("fn=")) {
      copy = says("memcpy") || says("memmove") || says("memset");
    } else if (line.starts_with("calls=")) {
      called = true;
    } else if (!line.empty() && (std::isdigit(static_cast<unsigned char>(line[0])) != 0)) {
      const auto space = line.find(' ');
      if (!std::exchange(called, false) && space != std::string::npos) {
        const double cost = std::atof(line.c_str() + space);
        sum.all += cost;
        (cipher ? sum.cipher : copy ? sum.copy : sum.all) += cipher || copy ? cost : 0;
      }
    }
  }
  return sum;
}

/// Runs `command` under callgrind. @return nothing if callgrind or the command failed
inline std::optional<Instructions> count_instructions(const std::string& command, const std::string& function,
                                                      const std::string& scratch_file) {
  const std::string run = "valgrind --tool=callgrind --compress-strings=no --compress-pos=no --callgrind-out-file='" +
                          scratch_file + "' '--toggle-collect=" + function + "' " + command + " >/dev/null 2>&1";
  const int status = std::system(run.c_str());
  std::ifstream file(scratch_file);
  const Instructions sum = read_callgrind(file);
  std::remove(scratch_file.c_str());
  if (status != 0 || sum.all == 0) return std::nullopt;
  return sum;
}

}  // namespace tandem::bench
