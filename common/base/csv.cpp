#include "common/base/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tandem {
namespace {

std::string_view trimmed(std::string_view s) noexcept {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
  return s;
}

/// Returns the part of a foreign text that a message may repeat: short and printable.
std::string shown(std::string_view s) {
  std::string out = "'";
  for (const char c : s.substr(0, 40)) out += c >= ' ' && c < 127 ? c : '?';
  return out + (s.size() > 40 ? "...'" : "'");
}

std::expected<CsvColumn, std::string> parse_header_cell(std::string_view cell) {
  const auto open = cell.find('[');
  if (open == std::string_view::npos || cell.back() != ']' || open + 2 >= cell.size()) {
    return std::unexpected(shown(cell) + ": a header cell is name[unit], e.g. t_s[s], or name[1] without unit");
  }
  const auto name = trimmed(cell.substr(0, open));
  if (name.empty()) return std::unexpected(shown(cell) + ": a column needs a name before its unit");
  return CsvColumn{std::string(name), std::string(cell.substr(open + 1, cell.size() - open - 2))};
}

}  // namespace

std::string CsvError::text(std::string_view file) const {
  std::string out(file);
  if (line > 0) out += ":" + std::to_string(line);
  out += ": ";
  if (column > 0) out += "column " + std::to_string(column) + ": ";
  return out + message;
}

std::optional<double> parse_number(std::string_view text) noexcept {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::expected<CsvTable, CsvError> CsvTable::parse(std::string_view text) {
  if (text.size() > kBytesMax) return std::unexpected(CsvError{0, 0, "more than 1 GiB"});
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark
  CsvTable table;
  table.text_ = text;
  const std::string_view all = table.text_;

  std::vector<Span> row;
  std::size_t begin = 0, line = 0;
  while (begin < all.size()) {
    ++line;
    const std::size_t newline = std::min(all.find('\n', begin), all.size());
    std::string_view content = all.substr(begin, newline - begin);
    if (content.ends_with('\r')) content.remove_suffix(1);
    if (const auto bad = content.find_first_of(std::string_view("\"\0", 2)); bad != std::string_view::npos) {
      return std::unexpected(CsvError{line, 0, content[bad] == '"' ? "quoted cells are not supported" : "a NUL byte"});
    }
    if (trimmed(content).empty()) {
      if (all.find_first_not_of(" \t\r\n", begin) == std::string_view::npos) break;
      return std::unexpected(CsvError{line, 0, "empty line inside the table"});
    }

    row.clear();
    for (std::size_t at = 0; at <= content.size();) {
      const std::size_t comma = std::min(content.find(',', at), content.size());
      const auto cell = trimmed(content.substr(at, comma - at));
      const auto offset = cell.empty() ? begin : static_cast<std::size_t>(cell.data() - all.data());
      row.push_back({static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(cell.size())});
      at = comma + 1;
    }

    if (table.columns_.empty()) {
      if (row.size() > kColumnsMax) return std::unexpected(CsvError{line, 0, "more than 1024 columns"});
      for (std::size_t i = 0; i < row.size(); ++i) {
        auto column = parse_header_cell(all.substr(row[i].begin, row[i].size));
        if (!column) return std::unexpected(CsvError{line, i + 1, column.error()});
        if (table.find(column->name))
          return std::unexpected(CsvError{line, i + 1, shown(column->name) + " appears twice"});
        table.columns_.push_back(std::move(*column));
      }
    } else {
      if (row.size() != table.columns_.size()) {
        return std::unexpected(CsvError{
            line, 0, std::to_string(row.size()) + " cells, the header has " + std::to_string(table.columns_.size())});
      }
      table.cells_.insert(table.cells_.end(), row.begin(), row.end());
      table.lines_.push_back(static_cast<std::uint32_t>(line));
    }
    begin = newline + 1;
  }
  if (table.columns_.empty()) return std::unexpected(CsvError{0, 0, "empty; a header name[unit],... is needed"});
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view name) const noexcept {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name == name) return i;
  }
  return std::nullopt;
}

std::string_view CsvTable::cell(std::size_t row, std::size_t column) const noexcept {
  const Span s = cells_[row * columns_.size() + column];
  return std::string_view(text_).substr(s.begin, s.size);
}

std::expected<std::optional<double>, CsvError> CsvTable::optional_number(std::size_t row, std::size_t column) const {
  const auto text = cell(row, column);
  if (text.empty()) return std::optional<double>{};
  const auto value = parse_number(text);
  if (!value)
    return std::unexpected(
        CsvError{line(row), column + 1, columns_[column].name + ": " + shown(text) + " is not a finite number"});
  return value;
}

std::expected<double, CsvError> CsvTable::number(std::size_t row, std::size_t column) const {
  auto value = optional_number(row, column);
  if (!value) return std::unexpected(std::move(value.error()));
  if (!*value) return std::unexpected(CsvError{line(row), column + 1, columns_[column].name + ": missing"});
  return **value;
}

}  // namespace tandem
