#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem {

/// Position and reason of an error in a table.
struct CsvError {
  std::size_t line = 0;    ///< from 1; 0: the text as a whole
  std::size_t column = 0;  ///< cell from 1; 0: the line as a whole
  std::string message;     ///< names the column and the value

  /// Returns `FILE:LINE: column N: message`.
  [[nodiscard]] std::string text(std::string_view file) const;
};

/// Header of one column.
struct CsvColumn {
  std::string name;
  std::string unit;  ///< text in brackets; `1` for plain numbers
};

/// A small, strict table. The first line is `name[unit],name[unit],...`; every row has as many cells, separated by
/// commas. Spaces around a cell are ignored and lines end with LF or CRLF. Quotes, comments and empty lines are not
/// supported, except empty lines at the very end. Cells are parsed on access, so an unused column may contain any text.
class CsvTable {
 public:
  static constexpr std::size_t kColumnsMax = 1024;
  static constexpr std::size_t kBytesMax = std::size_t{1} << 30;

  /// Parses a table. Errors: empty text, a header cell without unit or name, a duplicate name, a row of another length,
  /// quotes, NUL.
  [[nodiscard]] static std::expected<CsvTable, CsvError> parse(std::string_view text);

  [[nodiscard]] std::size_t rows() const noexcept { return lines_.size(); }
  [[nodiscard]] const std::vector<CsvColumn>& columns() const noexcept { return columns_; }
  /// Returns the index of the column called `name`.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const noexcept;
  /// Returns the line of the file [from 1] that contains row `row` [from 0].
  [[nodiscard]] std::size_t line(std::size_t row) const noexcept { return lines_[row]; }
  /// Returns the text of a cell without surrounding spaces; valid as long as the table.
  [[nodiscard]] std::string_view cell(std::size_t row, std::size_t column) const noexcept;
  /// Returns the finite number in a cell, or nullopt if the cell is empty. Errors: text, NaN, infinity.
  [[nodiscard]] std::expected<std::optional<double>, CsvError> optional_number(std::size_t row,
                                                                               std::size_t column) const;
  /// Returns the finite number in a cell. An empty cell is an error as well.
  [[nodiscard]] std::expected<double, CsvError> number(std::size_t row, std::size_t column) const;

 private:
  struct Span {
    std::uint32_t begin = 0, size = 0;
  };
  CsvTable() = default;

  std::string text_;
  std::vector<CsvColumn> columns_;
  std::vector<Span> cells_;  ///< rows() x columns_.size()
  std::vector<std::uint32_t> lines_;
};

/// Returns the whole text as one finite decimal number (a leading + is allowed), or nullopt.
[[nodiscard]] std::optional<double> parse_number(std::string_view text) noexcept;

}  // namespace tandem
