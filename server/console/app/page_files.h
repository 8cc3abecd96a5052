#pragma once

#include <span>
#include <string_view>

namespace tandem::console {

/// A file of the built page, compiled into the program (server/console/embed.cmake).
struct PageFile {
  std::string_view path;  ///< target of the request, such as "/assets/page.js"; "/" for index.html
  std::string_view type;  ///< Content-Type
  std::string_view etag;  ///< with its quotation marks
  std::string_view gzip;  ///< compressed bytes
};

[[nodiscard]] std::span<const PageFile> page_files() noexcept;

}  // namespace tandem::console
