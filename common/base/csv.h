#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem {

/// Where a table is wrong and why.
struct CsvError {
  std::size_t line = 0;    ///< from 1; 0: the text as a whole
  std::size_t column = 0;  ///< cell from 1; 0: the line as a whole
  std::string message;     ///< names the column and the value

  /// `FILE:LINE: column N: message`
  [[nodiscard]] std::string text(std::string_view file) const;
};

struct CsvColumn {
  std::string name;
  std::string unit;  ///< what stands in brackets; `1` for plain numbers
};

/// A small, strict table: first line `name[unit],name[unit],...`, then rows of as many cells separated by commas.
/// Spaces around a cell are ignored; lines end with LF or CRLF; no quotes, no comments, no empty lines except at the
/// very end. Cells stay text until they are asked for, so a column nobody reads may hold anything.
class CsvTable {
 public:
  static constexpr std::size_t kColumnsMax = 1024;
  static constexpr std::size_t kBytesMax = std::size_t{1} << 30;

  /// Error: empty text, a header cell without unit or name, a name twice, a row of another length, quotes, NUL.
  [[nodiscard]] static std::expected<CsvTable, CsvError> parse(std::string_view text);

  [[nodiscard]] std::size_t rows() const noexcept { return lines_.size(); }
  [[nodiscard]] const std::vector<CsvColumn>& columns() const noexcept { return columns_; }
  /// Index of the column called `name`.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const noexcept;
  /// Line of the file [from 1] that row `row` [from 0] stands in.
  [[nodiscard]] std::size_t line(std::size_t row) const noexcept { return lines_[row]; }
  /// Text of a cell without surrounding spaces. Valid as long as the table.
  [[nodiscard]] std::string_view cell(std::size_t row, std::size_t column) const noexcept;
  /// The finite number in a cell, none if the cell is empty. Error: text, NaN, infinity.
  [[nodiscard]] std::expected<std::optional<double>, CsvError> optional_number(std::size_t row,
                                                                               std::size_t column) const;
  /// The finite number in a cell. Error: also if it is empty.
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

/// A whole text as one finite decimal number (a leading + is allowed), or none.
[[nodiscard]] std::optional<double> parse_number(std::string_view text) noexcept;

}  // namespace tandem
