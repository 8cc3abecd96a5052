#include "common/io/whole_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace tandem::io {

std::expected<std::string, std::string> read_whole_file(const std::string& path, std::uintmax_t bytes_max) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return std::unexpected(path + ": " + error.message());
  if (size > bytes_max) return std::unexpected(path + ": is larger than " + std::to_string(bytes_max >> 20) + " MiB");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  file.read(text.data(), static_cast<std::streamsize>(size));
  if (!file) return std::unexpected(path + ": cannot be read: " + std::strerror(errno != 0 ? errno : EIO));
  return text;
}

}  // namespace tandem::io
