#include "common/io/output_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

namespace tandem::io {

OutputFile::~OutputFile() {
  if (file_ != nullptr && !on_stdout()) std::fclose(file_);
}

std::string OutputFile::open(const std::string& name, bool dash_is_stdout) {
  name_ = name;
  if (name.empty()) return {};
  if (name == "-" && dash_is_stdout) {
    file_ = stdout;
    return {};
  }
  file_ = std::fopen(name.c_str(), "wbe");
  return file_ != nullptr ? std::string{} : name + " cannot be written: " + std::strerror(errno);
}

void OutputFile::write(std::string_view text) noexcept {
  if (file_ != nullptr && std::fwrite(text.data(), 1, text.size(), file_) != text.size()) failed_ = true;
}

std::string OutputFile::close() {
  if (file_ == nullptr) return {};
  std::FILE* const file = std::exchange(file_, nullptr);
  const bool flushed = file == stdout ? std::fflush(file) == 0 : std::fclose(file) == 0;
  return flushed && !failed_ ? std::string{} : name_ + " could not be written to the end";
}

}  // namespace tandem::io
