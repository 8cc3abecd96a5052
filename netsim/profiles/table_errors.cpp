#include "netsim/profiles/table_errors.h"

namespace tandem::netsim {

void TableErrors::add(std::size_t line, std::size_t column, std::string_view key, std::string_view value,
                      std::string message) {
  if (full()) return;
  all_.push_back({file_, static_cast<int>(line), static_cast<int>(column), std::string(key),
                  std::string(value.substr(0, 40)), std::move(message)});
}

void TableErrors::add(const CsvTable& table, std::size_t row, std::size_t column, std::string message) {
  add(table.line(row), column + 1, table.columns()[column].name, table.cell(row, column), std::move(message));
}

}  // namespace tandem::netsim
