#include "netsim/demo/app/host_info.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

namespace tandem::netsim::demo {

std::string host_text() {
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  std::string text = std::to_string(cores) + (cores == 1 ? " core" : " cores");
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    if (const auto colon = line.find(": "); colon != std::string::npos) text += " (" + line.substr(colon + 2) + ")";
    break;
  }
  utsname system{};
  if (uname(&system) == 0) text += std::string(", ") + system.sysname + " " + system.release + ", " + system.machine;
  return text;
}

std::string date_text() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[40];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc)};
}

std::filesystem::path own_folder() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::current_path() : self.parent_path();
}

std::string file_link(const std::filesystem::path& path) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.~/";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string link = "file://";
  for (const char c : std::filesystem::absolute(path).lexically_normal().string()) {
    if (kPlain.find(c) != std::string_view::npos) {
      link += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      link += '%';
      link += kHex[byte >> 4];
      link += kHex[byte & 15u];
    }
  }
  return link;
}

}  // namespace tandem::netsim::demo
