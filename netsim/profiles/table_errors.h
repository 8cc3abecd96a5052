#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <utility>

#include "common/base/csv.h"
#include "proto/spec/input_error.h"

namespace tandem::netsim {

/// Collects the errors of one table, at most kMax of them.
class TableErrors {
 public:
  static constexpr std::size_t kMax = 50;

  explicit TableErrors(std::string_view file) : file_(file) {}

  /// Adds an error at a place of the file.
  /// @param line, column  from 1; 0: unknown
  /// @param value         rejected text; at most 40 characters of it are kept
  void add(std::size_t line, std::size_t column, std::string_view key, std::string_view value, std::string message);
  /// Adds an error about the whole table.
  void add(std::string message) { add(1, 1, "", "", std::move(message)); }
  /// Adds an error about a cell.
  void add(const CsvTable& table, std::size_t row, std::size_t column, std::string message);
  /// Adds the reason why a text is no table.
  void add(const CsvError& error) { add(error.line, error.column, "", "", error.message); }

  [[nodiscard]] bool empty() const noexcept { return all_.empty(); }
  [[nodiscard]] bool full() const noexcept { return all_.size() >= kMax; }
  /// Returns the errors and leaves none.
  [[nodiscard]] std::unexpected<InputErrors> take() { return std::unexpected(std::move(all_)); }

 private:
  std::string file_;
  InputErrors all_;
};

}  // namespace tandem::netsim
