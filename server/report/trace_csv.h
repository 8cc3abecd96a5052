#pragma once

#include <string>

#include "proto/spec/scene_spec.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Rows of a trace: `tick[1],t_s[s]`, then every seat, then every tool. Decimals are fixed, so that equal numbers give
/// equal bytes.
class TraceCsv {
 public:
  explicit TraceCsv(const SceneSpec& scene);
  [[nodiscard]] const std::string& header() const noexcept { return header_; }
  /// Appends one row with its line feed.
  void append(const TickRecord& record, std::string& out) const;

 private:
  const SceneSpec* scene_;
  std::size_t joints_;
  std::string header_;
};

}  // namespace tandem::server
