#include "netsim/demo/trace_data.h"

#include <cmath>
#include <limits>
#include <utility>

#include "common/base/csv.h"

namespace tandem::netsim::demo {
namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"}, kNumbers{"0", "1", "2"};

/// Takes columns by name and collects the names of missing ones.
class ColumnReader {
 public:
  explicit ColumnReader(const CsvTable& table) : table_(&table) {}

  void take(const std::string& name, Column& into) {
    const auto column = table_->find(name);
    if (!column) {
      missing_ += (missing_.empty() ? "" : ", ") + name;
      return;
    }
    into.resize(table_->rows());
    for (std::size_t r = 0; r < into.size(); ++r)
      into[r] = parse_number(table_->cell(r, *column)).value_or(std::numeric_limits<double>::quiet_NaN());
  }
  void take(const std::string& stem, const std::array<const char*, 3>& ends, Column3& into) {
    for (std::size_t a = 0; a < 3; ++a) take(stem + ends[a], into[a]);
  }
  /// Takes the columns of a hand; their names begin with `stem`.
  void take(const std::string& stem, HandColumns& into) {
    take(stem + "q", kNumbers, into.q);
    take(stem, kAxes, into.x);
    take(stem + "f_cmd_", kAxes, into.f_cmd);
    take(stem + "f_out_", kAxes, into.f_out);
  }
  [[nodiscard]] const std::string& missing() const noexcept { return missing_; }

 private:
  const CsvTable* table_;
  std::string missing_;
};

constexpr double kNear = 0.002;  // [s]
constexpr std::array<Column3 HandColumns::*, 4> kHandColumns{&HandColumns::q, &HandColumns::x, &HandColumns::f_cmd,
                                                             &HandColumns::f_out};

}  // namespace

std::expected<TraceData, std::string> read_trace(std::string_view text) {
  const auto table = CsvTable::parse(text);
  if (!table) return std::unexpected(table.error().text("trace"));
  if (table->rows() == 0) return std::unexpected("trace: no rows: the session never began");
  TraceData data;
  ColumnReader taker(*table);
  taker.take("t_s", data.t);
  for (const auto& [name, seat] : {std::pair{"trainer", &data.trainer}, std::pair{"trainee", &data.trainee}}) {
    const std::string stem = std::string(name) + ".";
    taker.take(stem + "alpha", seat->alpha);
    taker.take(stem, *seat);
  }
  taker.take("tool.q", kNumbers, data.tool.q);
  taker.take("tool.", kAxes, data.tool.x);
  taker.take("tool.f_cmd_", kAxes, data.tool.f_cmd);
  taker.take("tool.f_env_", kAxes, data.tool.f_env);
  taker.take("tool.e_p", kNumbers, data.tool.e_p);
  if (!taker.missing().empty()) return std::unexpected("trace: no column " + taker.missing());
  return data;
}

std::expected<SeatSamples, std::string> read_samples(std::string_view text) {
  const auto table = CsvTable::parse(text);
  if (!table) return std::unexpected(table.error().text("samples"));
  SeatSamples all;
  ColumnReader taker(*table);
  taker.take("t_s", all.t);
  taker.take("", all);
  if (!taker.missing().empty()) return std::unexpected("samples: no column " + taker.missing());
  // Rows of the session: ascending from 0.
  std::vector<std::size_t> rows;
  double newest = -1e-9;
  for (std::size_t k = 0; k < all.t.size(); ++k) {
    if (!(all.t[k] > newest)) continue;
    rows.push_back(k);
    newest = all.t[k];
  }
  if (rows.empty()) return std::unexpected("samples: no row of the session");
  const auto keep = [&](Column& column) {
    for (std::size_t n = 0; n < rows.size(); ++n) column[n] = column[rows[n]];
    column.resize(rows.size());
  };
  keep(all.t);
  for (const auto columns : kHandColumns)
    for (Column& column : all.*columns) keep(column);
  return all;
}

void put_samples(const Column& t, const SeatSamples& own, SeatTrace& seat) {
  std::size_t after = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    while (after < own.t.size() && own.t[after] < t[k]) ++after;
    // Before the first and after the last sample, the nearest sample may be half a tick away.
    const bool inside = after > 0 && after < own.t.size();
    const double gap = inside ? own.t[after] - own.t[after - 1] : 1;
    const double w = inside ? (t[k] - own.t[after - 1]) / gap : 0;
    const std::size_t edge = after == 0 ? 0 : own.t.size() - 1;
    const bool near = !own.t.empty() && std::abs(own.t[edge] - t[k]) < kNear;
    for (const auto columns : kHandColumns)
      for (std::size_t a = 0; a < 3; ++a) {
        const Column& c = (own.*columns)[a];
        (seat.*columns)[a][k] = inside ? c[after - 1] + w * (c[after] - c[after - 1])
                                       : (near ? c[edge] : std::numeric_limits<double>::quiet_NaN());
      }
  }
}

}  // namespace tandem::netsim::demo
