#include "common/io/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace tandem::io {

OutputFile::~OutputFile() {
  if (file_ != nullptr && !on_stdout()) std::fclose(file_);
}

std::string OutputFile::problem(const std::string& name) {
  std::error_code error;
  if (std::filesystem::is_directory(name, error)) return name + " cannot be written: it is a folder";
  const bool exists = std::filesystem::exists(name, error);
  const std::filesystem::path parent = std::filesystem::path(name).parent_path();
  const std::string target = exists ? name : parent.empty() ? "." : parent.string();
  if (access(target.c_str(), W_OK) == 0 && (exists || std::filesystem::is_directory(target, error))) return {};
  return name + " cannot be written: " + (exists ? "" : target + ": ") + std::strerror(errno != 0 ? errno : ENOTDIR);
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
