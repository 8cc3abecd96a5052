#include "hal/io/motion_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace tandem::hal {

std::expected<std::shared_ptr<const sim::RecordedMotion>, std::string> load_motion(const sim::MotionOptions& options) {
  std::error_code error;
  if (std::filesystem::is_directory(options.file, error)) return std::unexpected(options.file + ": is a directory");
  errno = 0;
  std::ifstream in(options.file, std::ios::binary);
  std::ostringstream text;
  // An empty file is no trouble of reading: the parser says what it misses.
  if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (in.eof()) in.clear();
  if (!in || !text) {
    const int code = errno != 0 ? errno : EIO;
    return std::unexpected(options.file + ": cannot be read: " + std::generic_category().message(code));
  }
  auto motion = sim::RecordedMotion::parse(text.view(), options, options.file);
  if (!motion) return std::unexpected(std::move(motion.error()));
  return std::make_shared<const sim::RecordedMotion>(std::move(*motion));
}

}  // namespace tandem::hal
