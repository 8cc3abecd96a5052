#include "hal/io/motion_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace tandem::hal {
namespace {

constexpr std::size_t kChunk = 1 << 16;
constexpr std::size_t kBytesMax = std::size_t{256} << 20;  // less than a day at 1 kHz, far more than a session

}  // namespace

std::expected<std::shared_ptr<const sim::RecordedMotion>, std::string> load_motion(const sim::MotionOptions& options) {
  std::error_code error;
  if (std::filesystem::is_directory(options.file, error)) return std::unexpected(options.file + ": is a directory");
  errno = 0;
  std::ifstream in(options.file, std::ios::binary);
  std::string text;
  std::vector<char> chunk(kChunk);
  // Reading an empty file succeeds; the parser reports what is missing.
  while (in && in.peek() != std::ifstream::traits_type::eof()) {
    in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const std::string_view got{chunk.data(), static_cast<std::size_t>(in.gcount())};
    // Checked in every chunk: a device file such as /dev/zero never ends.
    if (got.find('\0') != std::string_view::npos)
      return std::unexpected(options.file + ": is not text: it has the byte 0x00; a recording is a CSV file");
    if (text.size() + got.size() > kBytesMax)
      return std::unexpected(options.file + ": is longer than " + std::to_string(kBytesMax >> 20) +
                             " MiB: not a recording of a hand");
    text += got;
  }
  if (in.eof()) in.clear();
  if (!in) {
    const int code = errno != 0 ? errno : EIO;
    return std::unexpected(options.file + ": cannot be read: " + std::generic_category().message(code));
  }
  auto motion = sim::RecordedMotion::parse(text, options, options.file);
  if (!motion) return std::unexpected(std::move(motion.error()));
  return std::make_shared<const sim::RecordedMotion>(std::move(*motion));
}

}  // namespace tandem::hal
