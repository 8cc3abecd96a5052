#include "netsim/score/motion_lesson.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/base/csv.h"
#include "common/base/format.h"
#include "netsim/score/triple.h"

namespace tandem::netsim::score {
namespace {

constexpr std::size_t kRowsMin = 5;
constexpr double kStepMin = 1e-5, kStepMax = 0.1;  // [s] median
constexpr double kStopTicks = 2;                   // between two recordings

/// Three columns whose names differ in one letter.
struct ColumnTriple {
  std::string name;  ///< the common parts, without separators at their ends
  std::array<std::size_t, 3> columns{};
  double factor = 1;  ///< to SI
};

std::string without_separators(std::string text) {
  while (!text.empty() && text.back() == '_') text.pop_back();
  while (!text.empty() && text.front() == '_') text.erase(0, 1);
  return text;
}

/// Returns the triples of columns in a unit.
std::vector<ColumnTriple> triples(const CsvTable& table, std::string_view unit, double factor) {
  std::vector<ColumnTriple> out;
  for (std::size_t c = 0; c < table.columns().size(); ++c) {
    const CsvColumn& column = table.columns()[c];
    if (column.unit != unit) continue;
    for (std::size_t at = 0; at < column.name.size(); ++at) {
      if (column.name[at] != 'x') continue;
      std::string name = column.name;
      name[at] = 'y';
      const auto y = table.find(name);
      name[at] = 'z';
      const auto z = table.find(name);
      if (!y || !z || table.columns()[*y].unit != unit || table.columns()[*z].unit != unit) continue;
      std::string before = column.name.substr(0, at);
      if (before.ends_with('p') || before.ends_with('f')) before.pop_back();  // px_m, giver_fx_N
      out.push_back({without_separators(before), {c, *y, *z}, factor});
      break;
    }
  }
  return out;
}

using QuaternionColumns = std::array<std::size_t, 4>;

/// Returns the columns of a hand's orientation, `NAME_q0[1]` ... `q3`, or `qx`, `qy`, `qz`, `qw`.
std::optional<QuaternionColumns> orientation_of(const CsvTable& table, const std::string& hand) {
  const std::string prefix = hand.empty() ? "" : hand + "_";
  for (const char* letters : {"0123", "xyzw"}) {
    QuaternionColumns columns{};
    bool all = true;
    for (std::size_t c = 0; c < 4 && all; ++c) {
      const auto found = table.find(prefix + "q" + letters[c]);
      all = found && table.columns()[*found].unit == "1";
      if (all) columns[c] = *found;
    }
    if (all) return columns;
  }
  return {};
}

std::string_view first_word(std::string_view name) { return name.substr(0, name.find('_')); }

/// One row of the file.
struct MotionRow {
  double t = 0, rec = 0;
  std::size_t index = 0;  ///< of the table
};

/// Everything that is read from the table before its rows become ticks.
struct Source {
  CsvTable table;
  std::vector<ColumnTriple> hands;
  std::vector<std::optional<ColumnTriple>> forces;  ///< by hand
  std::vector<std::optional<QuaternionColumns>> orientations;
  std::vector<MotionRow> rows;
  double step_s = 0;
};

std::expected<std::vector<MotionRow>, CsvError> rows_of(const CsvTable& table, std::size_t time, double factor) {
  const auto rec = table.find("rec");
  std::vector<MotionRow> rows;
  rows.reserve(table.rows());
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const auto t = table.number(r, time);
    if (!t) return std::unexpected(t.error());
    MotionRow row{*t * factor, 0, r};
    if (rec) {
      const auto number = table.number(r, *rec);
      if (!number) return std::unexpected(number.error());
      row.rec = *number;
    }
    if (!rows.empty() && rows.back().rec == row.rec && !(row.t > rows.back().t))
      return std::unexpected(CsvError{
          table.line(r), time + 1,
          table.columns()[time].name + format(": %.9g s is not after the row before, %.9g s", row.t, rows.back().t)});
    rows.push_back(row);
  }
  return rows;
}

std::expected<Source, std::string> read_source(std::string_view csv, const std::string& file) {
  auto table = CsvTable::parse(csv);
  if (!table) return std::unexpected(table.error().text(file));
  Source source{std::move(*table), {}, {}, {}, {}, 0};
  std::optional<std::size_t> time;
  double factor = 1;
  for (const char* name : {"t_s", "t", "time", "t_ms"})
    if (const auto found = source.table.find(name); found && !time) {
      const std::string& unit = source.table.columns()[*found].unit;
      if (unit != "s" && unit != "ms") continue;
      time = found;
      factor = unit == "ms" ? 1e-3 : 1;
    }
  if (!time) return std::unexpected(file + ":1: no column of time; add t_s[s], t[s], time[s] or t_ms[ms]");
  source.hands = triples(source.table, "m", 1);
  for (ColumnTriple& in_mm : triples(source.table, "mm", 1e-3)) source.hands.push_back(std::move(in_mm));
  if (source.hands.empty())
    return std::unexpected(
        file +
        ":1: no triple of positions in [m] or [mm], such as px_m[m],py_m[m],pz_m[m]; this file holds "
        "no motion to score");
  if (source.hands.size() > kMastersMax)
    return std::unexpected(file + ":1: " + std::to_string(source.hands.size()) + " triples of positions; at most " +
                           std::to_string(kMastersMax) + " can be scored");
  const std::vector<ColumnTriple> forces = triples(source.table, "N", 1);
  for (const ColumnTriple& hand : source.hands) {
    const auto own = std::ranges::find_if(
        forces, [&](const ColumnTriple& f) { return first_word(f.name) == first_word(hand.name); });
    const bool only = source.hands.size() == 1 && forces.size() == 1;
    source.forces.push_back(own != forces.end() ? std::optional(*own)
                            : only              ? std::optional(forces.front())
                                                : std::nullopt);
    source.orientations.push_back(orientation_of(source.table, hand.name));
  }
  auto rows = rows_of(source.table, *time, factor);
  if (!rows) return std::unexpected(rows.error().text(file));
  source.rows = std::move(*rows);
  std::vector<double> steps;
  for (std::size_t r = 1; r < source.rows.size(); ++r)
    if (source.rows[r].rec == source.rows[r - 1].rec) steps.push_back(source.rows[r].t - source.rows[r - 1].t);
  if (steps.size() + 1 < kRowsMin)
    return std::unexpected(file + ": " + std::to_string(source.rows.size()) + " rows; at least " +
                           std::to_string(kRowsMin) + " are needed");
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  source.step_s = *middle;
  if (source.step_s < kStepMin || source.step_s > kStepMax)
    return std::unexpected(
        file + format(": the median step is %.6g s; allowed are %g to %g s", source.step_s, kStepMin, kStepMax));
  return source;
}

SceneSpec scene_of(const Source& source, const std::string& file) {
  SceneSpec scene;
  const std::size_t slash = file.rfind('/');
  scene.name = slash == std::string::npos ? file : file.substr(slash + 1);
  scene.tick_hz = std::round(1e3 / source.step_s) / 1e3;
  scene.gate.force_max = INFINITY;
  for (const ColumnTriple& hand : source.hands) {
    SeatSpec seat;
    seat.name = hand.name.empty() ? "hand" : hand.name;
    seat.device.force_peak = INFINITY;
    scene.follow[scene.seats.size()][0] = 1;
    scene.seats.push_back(std::move(seat));
  }
  ToolSpec tool;
  tool.name = "tool";
  scene.tools.push_back(tool);
  return scene;
}

/// Reads three cells of a row; NaN where a cell is empty.
std::expected<LessonTriple, CsvError> cells(const CsvTable& table, std::size_t row, const ColumnTriple& triple) {
  LessonTriple out = kUnknownTriple;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto value = table.optional_number(row, triple.columns[a]);
    if (!value) return std::unexpected(value.error());
    if (*value) out[a] = **value * triple.factor;
  }
  return out;
}

constexpr std::array<double, 4> kUnknownOrientation{kUnknown, kUnknown, kUnknown, kUnknown};
constexpr double kNormTolerance = 0.1;  // of a quaternion; motion capture writes zeros where it lost a body

/// Reads an orientation; NaN where a cell is empty or the quaternion has no unit length.
std::expected<std::array<double, 4>, CsvError> orientation_in(const CsvTable& table, std::size_t row,
                                                              const QuaternionColumns& columns) {
  std::array<double, 4> out = kUnknownOrientation;
  double square = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto value = table.optional_number(row, columns[c]);
    if (!value) return std::unexpected(value.error());
    if (*value) out[c] = **value;
    square += out[c] * out[c];
  }
  return std::abs(std::sqrt(square) - 1) < kNormTolerance ? out : kUnknownOrientation;
}

/// Appends rows to a lesson, tick by tick.
class TickWriter {
 public:
  TickWriter(Lesson& lesson, const Source& source) : lesson_(lesson), source_(source) {
    positions_.resize(source.hands.size());
    forces_.resize(source.hands.size());
    orientations_.resize(source.hands.size());
  }

  /// Reads all cells. Error: position of the cell.
  [[nodiscard]] std::expected<void, CsvError> read() {
    for (const MotionRow& row : source_.rows)
      for (std::size_t h = 0; h < source_.hands.size(); ++h) {
        auto x = cells(source_.table, row.index, source_.hands[h]);
        if (!x) return std::unexpected(x.error());
        positions_[h].push_back(*x);
        if (source_.orientations[h]) {
          auto q = orientation_in(source_.table, row.index, *source_.orientations[h]);
          if (!q) return std::unexpected(q.error());
          orientations_[h].push_back(*q);
        }
        if (!source_.forces[h]) continue;
        auto f = cells(source_.table, row.index, *source_.forces[h]);
        if (!f) return std::unexpected(f.error());
        forces_[h].push_back(*f);
      }
    return {};
  }

  /// Appends the ticks of rows [begin, end), which are one recording, from tick `first` on. @return the tick after it
  std::uint32_t write(std::size_t begin, std::size_t end, std::uint32_t first) {
    const std::vector<MotionRow>& rows = source_.rows;
    const double start = rows[begin].t, step = 1 / lesson_.scene.tick_hz;
    std::size_t r = begin;
    std::uint32_t last = first;
    while (r < end) {
      // The tick nearest to the next row that no tick has yet.
      const double nearest = std::floor((rows[r].t - start) / step + 0.5);
      if (!(nearest < 4e9 - first)) return last;
      const auto k = static_cast<std::uint32_t>(nearest);
      const double t = start + k * step;
      std::size_t after = r;
      while (after < end && rows[after].t < t) ++after;
      if (after == end) {
        put(first + k, end - 1, end - 1, 0);
      } else if (after == begin || rows[after].t == t) {
        put(first + k, after, after, 0);
      } else {
        put(first + k, after - 1, after, (t - rows[after - 1].t) / (rows[after].t - rows[after - 1].t));
      }
      last = first + k;
      while (r < end && rows[r].t - start < (k + 0.5) * step) ++r;
    }
    return last + 1;
  }

  /// Appends a tick in which the session did not run: it separates two recordings.
  void stop(std::uint32_t tick) {
    put(tick, 0, 0, 0);
    lesson_.running.back() = 0;
  }

 private:
  void put(std::uint32_t tick, std::size_t a, std::size_t b, double w) {
    lesson_.tick.push_back(tick);
    lesson_.time_ns.push_back(std::llround(tick / lesson_.scene.tick_hz * 1e9));
    lesson_.running.push_back(1);
    for (std::size_t h = 0; h < positions_.size(); ++h) {
      lesson_.seats[h].x.push_back(interpolated(positions_[h][a], positions_[h][b], w));
      if (!forces_[h].empty()) lesson_.seats[h].f.push_back(interpolated(forces_[h][a], forces_[h][b], w));
      if (!orientations_[h].empty())
        lesson_.seats[h].orientation.push_back(between(orientations_[h][a], orientations_[h][b], w));
    }
  }

  /// Orientation at a share `w` of the way, on the shorter arc; of unit length after the filter.
  static std::array<double, 4> between(const std::array<double, 4>& a, const std::array<double, 4>& b, double w) {
    double cosine = 0;
    for (std::size_t c = 0; c < 4; ++c) cosine += a[c] * b[c];
    std::array<double, 4> out{};
    for (std::size_t c = 0; c < 4; ++c) out[c] = interpolated(a[c], cosine < 0 ? -b[c] : b[c], w);
    return out;
  }

  Lesson& lesson_;
  const Source& source_;
  std::vector<std::vector<LessonTriple>> positions_, forces_;     ///< by hand, then by row of the file
  std::vector<std::vector<std::array<double, 4>>> orientations_;  ///< the same; empty: the hand has none
};

}  // namespace

std::expected<Lesson, std::string> read_motion(std::string_view csv, const std::string& file) {
  const auto source = read_source(csv, file);
  if (!source) return std::unexpected(source.error());
  Lesson lesson;
  lesson.scene = scene_of(*source, file);
  lesson.session = lesson.scene.name;
  lesson.seats.resize(lesson.scene.seats.size());
  lesson.tools.resize(1);
  TickWriter writer(lesson, *source);
  if (const auto read = writer.read(); !read) return std::unexpected(read.error().text(file));
  const std::vector<MotionRow>& rows = source->rows;
  std::uint32_t next = 0;
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin;
    while (end < rows.size() && rows[end].rec == rows[begin].rec) ++end;
    if (begin > 0) {
      writer.stop(next);
      next += static_cast<std::uint32_t>(kStopTicks);
    }
    const std::uint32_t first = next;
    next = writer.write(begin, end, first);
    if (begin > 0 || end < rows.size())
      lesson.scene.phases.push_back(
          {format("rec %g", rows[begin].rec), first / lesson.scene.tick_hz, next / lesson.scene.tick_hz, false});
    begin = end;
  }
  return lesson;
}

}  // namespace tandem::netsim::score
