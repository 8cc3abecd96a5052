#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace tandem::io {

/// Why something could not be written, for a person, by errno: a full disk is called full, a missing permission a permission.
[[nodiscard]] std::string why_not_written(int error);

/// A file a person named for results: judged before anything starts, so that a name that cannot be written is a mistake
/// found early; checked to the last byte. `-` is standard output where allowed.
class OutputFile {
 public:
  OutputFile() = default;
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Why a file of this name could not be written, empty if it could. Touches nothing.
  [[nodiscard]] static std::string problem(const std::string& name);
  /// @param name  empty: nothing is wanted, every write is ignored
  /// @return what is wrong, empty if nothing
  [[nodiscard]] std::string open(const std::string& name, bool dash_is_stdout);
  void write(std::string_view text) noexcept;
  /// @return what is wrong; empty if every byte was written, or nobody reads standard output any more
  [[nodiscard]] std::string close();

  [[nodiscard]] bool wanted() const noexcept { return file_ != nullptr; }
  [[nodiscard]] bool on_stdout() const noexcept { return file_ == stdout; }

 private:
  std::string name_;
  std::FILE* file_ = nullptr;
  int failed_ = 0;  ///< errno of the first write that failed
};

}  // namespace tandem::io
