#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tandem::test {

/// A trace as a program wrote it: numbers by column name without unit. An incomplete last row is ignored.
class Trace {
 public:
  explicit Trace(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    std::istringstream names(line);
    for (std::string name; std::getline(names, name, ',');) columns_[name.substr(0, name.find('['))] = columns_.size();
    while (std::getline(lines, line)) {
      if (lines.eof()) break;
      std::vector<double> row;
      for (const char* at = line.c_str(); *at != '\0';) {
        char* end = nullptr;
        row.push_back(std::strtod(at, &end));
        at = *end == ',' ? end + 1 : end;
        if (end == at && *at != '\0') break;
      }
      if (row.size() == columns_.size()) rows_.push_back(std::move(row));
    }
  }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }
  [[nodiscard]] double at(std::size_t row, const std::string& column) const {
    const auto found = columns_.find(column);
    EXPECT_NE(found, columns_.end()) << column;
    return found == columns_.end() ? NAN : rows_[row][found->second];
  }
  /// The columns `stem`x, `stem`y and `stem`z.
  [[nodiscard]] std::array<double, 3> triple(std::size_t row, const std::string& stem) const {
    return {at(row, stem + "x"), at(row, stem + "y"), at(row, stem + "z")};
  }

 private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<double>> rows_;
};

inline double norm(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
inline double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return norm({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

}  // namespace tandem::test
