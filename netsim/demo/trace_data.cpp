#include "netsim/demo/trace_data.h"

#include <limits>

#include "common/base/csv.h"

namespace tandem::netsim::demo {
namespace {

/// Takes columns by name and remembers which were not there.
class Taker {
 public:
  explicit Taker(const CsvTable& table) : table_(&table) {}

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
  [[nodiscard]] const std::string& missing() const noexcept { return missing_; }

 private:
  const CsvTable* table_;
  std::string missing_;
};

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"}, kNumbers{"0", "1", "2"};

}  // namespace

std::expected<TraceData, std::string> read_trace(std::string_view text) {
  const auto table = CsvTable::parse(text);
  if (!table) return std::unexpected(table.error().text("trace"));
  if (table->rows() == 0) return std::unexpected("trace: no rows: the session never began");
  TraceData data;
  Taker taker(*table);
  taker.take("t_s", data.t);
  for (const auto& [name, seat] : {std::pair{"trainer", &data.trainer}, std::pair{"trainee", &data.trainee}}) {
    const std::string stem = std::string(name) + ".";
    taker.take(stem + "alpha", seat->alpha);
    taker.take(stem + "q", kNumbers, seat->q);
    taker.take(stem, kAxes, seat->x);
    taker.take(stem + "f_cmd_", kAxes, seat->f_cmd);
    taker.take(stem + "f_out_", kAxes, seat->f_out);
  }
  taker.take("tool.q", kNumbers, data.tool.q);
  taker.take("tool.", kAxes, data.tool.x);
  taker.take("tool.f_cmd_", kAxes, data.tool.f_cmd);
  taker.take("tool.f_env_", kAxes, data.tool.f_env);
  taker.take("tool.e_p", kNumbers, data.tool.e_p);
  if (!taker.missing().empty()) return std::unexpected("trace: no column " + taker.missing());
  return data;
}

}  // namespace tandem::netsim::demo
