#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace tandem::io {

/// Returns for users why a write failed, by errno, with a specific text for a full disk and for a missing permission.
[[nodiscard]] std::string write_error_text(int error);

/// An output file named by the user for results. Its name is checked before any work starts, so that an unusable name
/// is reported early. Writes are checked to the last byte. `-` is standard output where allowed.
class OutputFile {
 public:
  OutputFile() = default;
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Returns why a file of this name could not be written, empty if it could. Creates nothing.
  [[nodiscard]] static std::string problem(const std::string& name);
  /// @param name  empty: no output is wanted, every write is ignored
  /// @return the error, empty if none
  [[nodiscard]] std::string open(const std::string& name, bool dash_is_stdout);
  void write(std::string_view text) noexcept;
  /// A file of which the disk took no byte is removed.
  /// @return the error; empty if every byte was written, or if the reader of standard output has closed it
  [[nodiscard]] std::string close();

  [[nodiscard]] bool is_open() const noexcept { return file_ != nullptr; }
  [[nodiscard]] bool on_stdout() const noexcept { return file_ == stdout; }

 private:
  std::string name_;
  std::FILE* file_ = nullptr;
  int failed_ = 0;  ///< errno of the first write that failed
};

}  // namespace tandem::io
