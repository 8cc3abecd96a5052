#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>

#include "common/io/fd.h"

namespace tandem::server {

/// A file without a name in the folder of recordings, in which a session keeps its inputs. Only its descriptor refers
/// to it, so the system frees it when the session or the process ends, however it ends. One thread appends; any thread
/// reads what was appended before. Calls may wait for the disk.
class InputSpool {
 public:
  static constexpr std::uint64_t kFreeMin = std::uint64_t{256} << 20U;  ///< [bytes] that the disk keeps free

  /// @param folder  that exists
  /// @return error: why the file cannot be made, without its name
  [[nodiscard]] static std::expected<InputSpool, std::string> create(const std::string& folder);

  /// Appends bytes. @return why not all of them were written: then none count; empty: they were
  [[nodiscard]] std::string append(std::string_view bytes);
  /// Reads `out.size()` bytes from a place. @return whether the file has all of them
  [[nodiscard]] bool read(std::uint64_t at, std::span<std::byte> out) const noexcept;
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

 private:
  explicit InputSpool(io::Fd file) : file_(std::move(file)) {}

  io::Fd file_;
  std::uint64_t size_ = 0;
};

/// Removes spools that a killed server left. Few file systems leave any: those that cannot make files without a name.
void remove_stale_spools(const std::string& folder);

}  // namespace tandem::server
