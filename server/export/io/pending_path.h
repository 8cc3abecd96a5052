#pragma once

#include <functional>
#include <string>

namespace tandem::server {

/// Receives the finished share of an export [0, 1]. Returns false to end it.
using ExportProgress = std::function<bool(double share)>;

/// Error text of an export that `ExportProgress` ended.
inline constexpr const char* kExportInterrupted = "interrupted; nothing was written";

/// A file or folder under a temporary name beside its target. It takes the name of the target when it is complete, so
/// that no half file ever has that name. Only a killed process leaves the temporary name, TARGET.part-PID, behind.
class PendingPath {
 public:
  explicit PendingPath(std::string target);
  ~PendingPath();  ///< removes what `commit` has not renamed
  PendingPath(const PendingPath&) = delete;
  PendingPath& operator=(const PendingPath&) = delete;

  /// Returns why the target could not be written, such as a folder with other files in it; empty: it could.
  /// @param replace  a file of that name may be replaced
  [[nodiscard]] static std::string problem(const std::string& target, bool folder, bool replace);
  /// The temporary name.
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Puts the data on disk and renames. A file of that name is replaced, a folder only if it is empty.
  /// @return the error, empty if the target is complete
  [[nodiscard]] std::string commit();

 private:
  std::string target_, path_;
  bool committed_ = false;
};

}  // namespace tandem::server
