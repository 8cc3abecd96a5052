#include "hal/sim/recorded_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/csv.h"

namespace tandem::hal::sim {
namespace {

constexpr double kReach = 0.060;  // [m] automatic scaling shrinks larger recordings to this excursion
constexpr double kScaleMax = 1e3;
constexpr double kRepeatMax =
    0.010;                        // [s] a shorter repetition of a position comes from the logger, not from the operator
constexpr double kBackMin = 0.5;  // [s] shortest return of a looped motion
constexpr double kBackSpeed = 0.1;  // [m/s]

using Text = std::string_view;

std::string quoted(Text s) { return "'" + std::string(s.substr(0, 60)) + "'"; }

std::string shown(double v) {
  std::string s = std::to_string(v);
  s.erase(s.find_last_not_of('0') + 1);
  if (s.ends_with('.')) s += '0';
  return s;
}

std::expected<std::array<MotionOptions::Axis, 3>, std::string> parse_axes(Text value) {
  const auto wrong = [&] {
    return std::unexpected("axes=" + std::string(value) +
                           ": three signed letters, each of x, y, z once, e.g. +x+y+z or -y+x+z");
  };
  if (value.size() != 6) return wrong();
  std::array<MotionOptions::Axis, 3> axes{};
  unsigned seen = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const char sign = value[2 * i], letter = value[2 * i + 1];
    if ((sign != '+' && sign != '-') || letter < 'x' || letter > 'z') return wrong();
    axes[i] = {letter - 'x', sign == '-' ? -1.0 : 1.0};
    seen |= 1U << (letter - 'x');
  }
  if (seen != 7U) return wrong();
  return axes;
}

/// Name of a position column without `_m` or `_mm` and without its axis letter: `px_m` -> ("p", 0), `baton_x` ->
/// ("baton", 0).
struct PositionName {
  std::string prefix;
  int axis = 0;
};
std::optional<PositionName> position_name(Text name) {
  if (name.ends_with("_mm")) {
    name.remove_suffix(3);
  } else if (name.ends_with("_m")) {
    name.remove_suffix(2);
  }
  if (name.size() < 2) return std::nullopt;
  const char letter = name.back();
  if (letter < 'x' || letter > 'z') return std::nullopt;
  const Text stem = name.substr(0, name.size() - 1);
  if (stem == "p") return PositionName{"p", letter - 'x'};
  if (stem.size() < 2 || !stem.ends_with('_')) return std::nullopt;
  return PositionName{std::string(stem.substr(0, stem.size() - 1)), letter - 'x'};
}

struct Triple {
  std::string prefix;
  std::array<std::optional<std::size_t>, 3> column;
  [[nodiscard]] bool whole() const { return column[0] && column[1] && column[2]; }
};

std::expected<std::array<std::size_t, 3>, std::string> find_triple(const CsvTable& table, std::string& wanted,
                                                                   Text file) {
  std::vector<Triple> triples;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const auto& column = table.columns()[i];
    if (column.unit != "m" && column.unit != "mm") continue;
    const auto name = position_name(column.name);
    if (!name) continue;
    auto it = std::find_if(triples.begin(), triples.end(), [&](const Triple& t) { return t.prefix == name->prefix; });
    if (it == triples.end()) it = triples.insert(triples.end(), Triple{name->prefix, {}});
    auto& cell = it->column[static_cast<std::size_t>(name->axis)];
    if (cell) {
      return std::unexpected(std::string(file) + ":1: columns " + quoted(table.columns()[*cell].name) + " and " +
                             quoted(column.name) + " are the same position");
    }
    cell = i;
  }
  std::erase_if(triples, [](const Triple& t) { return !t.whole(); });
  std::string known;
  for (const auto& t : triples) known += (known.empty() ? "" : ", ") + t.prefix;
  const std::string rule = "position columns are PREFIX_x, PREFIX_y, PREFIX_z or px, py, pz in [m] or [mm]";
  if (wanted.empty()) {
    if (triples.empty()) return std::unexpected(std::string(file) + ":1: no position columns; " + rule);
    if (triples.size() > 1)
      return std::unexpected(std::string(file) + ":1: several positions; choose columns= one of " + known);
    wanted = triples.front().prefix;
  }
  for (const auto& t : triples) {
    if (t.prefix == wanted) return std::array{*t.column[0], *t.column[1], *t.column[2]};
  }
  return std::unexpected(std::string(file) + ":1: columns=" + wanted + " not found; " +
                         (known.empty() ? rule : "the file has " + known));
}

struct TimeColumn {
  std::size_t index;
  double unit;  ///< [s]
};
std::expected<TimeColumn, std::string> find_time(const CsvTable& table, Text file) {
  for (const Text name : {"t_s", "t", "time", "time_s", "t_ms", "time_ms"}) {
    const auto i = table.find(name);
    if (!i) continue;
    const auto& unit = table.columns()[*i].unit;
    if (unit == "s") return TimeColumn{*i, 1.0};
    if (unit == "ms") return TimeColumn{*i, 1e-3};
    return std::unexpected(std::string(file) + ":1: column " + quoted(name) + " has unit [" + unit +
                           "]; allowed [s], [ms]");
  }
  return std::unexpected(std::string(file) + ":1: no time column; t_s[s] is needed");
}

/// Changes a tangent at one end of an interval so that the curve stays between the interval's ends there, on every
/// axis: at a pause, and in an interval that is long beside its neighbour, such as a gap of the recording. Otherwise
/// the last slope before it would swing the curve far out. A tangent of at most three slopes keeps an interval monotone
/// [Fritsch and Carlson 1980].
/// @param slope  of the interval  @param length, neighbour  of the interval and of the one at the tangent's other side
/// [s]
void keep_between_ends(Vec3& tangent, const Vec3& slope, double length, double neighbour) {
  constexpr double kLong = 8;
  if (length <= kLong * neighbour && !slope.isZero(0)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double limit = std::max(0.0, 3 * slope[axis] * (tangent[axis] < 0 ? -1 : 1));
    tangent[axis] = std::clamp(tangent[axis], -limit, limit);
  }
}

}  // namespace

std::expected<void, std::string> set_motion_option(MotionOptions& options, Text name, Text value) {
  const std::string whole = std::string(name) + "=" + std::string(value);
  if (name == "columns") {
    if (value.empty()) return std::unexpected("columns=: the prefix of the position columns is missing");
    options.columns = value;
  } else if (name == "rec") {
    const auto n = parse_number(value);
    if (!n) return std::unexpected(whole + ": the number of a recording");
    options.rec = n;
  } else if (name == "scale") {
    options.scale.reset();
    if (value == "auto") return {};
    const auto s = parse_number(value);
    if (!s || !(*s > 0.0) || *s > kScaleMax) return std::unexpected(whole + ": auto or a factor above 0, at most 1000");
    options.scale = s;
  } else if (name == "axes") {
    auto axes = parse_axes(value);
    if (!axes) return std::unexpected(std::move(axes.error()));
    options.axes = *axes;
  } else if (name == "end") {
    if (value != "hold" && value != "loop") return std::unexpected(whole + ": hold or loop");
    options.loop = value == "loop";
  } else if (name == "middle") {
    if (value != "zero" && value != "keep") return std::unexpected(whole + ": zero or keep");
    options.keep_middle = value == "keep";
  } else {
    return std::unexpected(quoted(name) +
                           " is no option of a recorded hand; valid: columns, rec, scale, axes, end, middle");
  }
  return {};
}

std::expected<MotionOptions, std::string> parse_motion_options(Text text) {
  MotionOptions options;
  std::vector<Text> seen;
  for (bool first = true; first || !text.empty(); first = false) {
    const auto comma = std::min(text.find(','), text.size());
    const Text part = text.substr(0, comma);
    if (comma + 1 == text.size()) return std::unexpected("a comma at the end");
    text.remove_prefix(std::min(comma + 1, text.size()));
    if (first) {
      if (part.empty() || part.find('=') != Text::npos)
        return std::unexpected("FILE.csv must come first, not " + quoted(part));
      options.file = part;
      continue;
    }
    const auto equals = part.find('=');
    if (equals == Text::npos)
      return std::unexpected(quoted(part) + ": name=value is needed; valid: columns, rec, scale, axes, end, middle");
    const Text name = part.substr(0, equals);
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
      return std::unexpected(quoted(name) + " is given twice");
    seen.push_back(name);
    if (auto ok = set_motion_option(options, name, part.substr(equals + 1)); !ok)
      return std::unexpected(std::move(ok.error()));
  }
  return options;
}

std::expected<RecordedMotion, std::string> RecordedMotion::parse(Text csv, const MotionOptions& options, Text file) {
  const auto table = CsvTable::parse(csv);
  if (!table) return std::unexpected(table.error().text(file));
  RecordedMotion motion;
  motion.columns_ = options.columns;
  motion.loop_ = options.loop;
  const auto columns = find_triple(*table, motion.columns_, file);
  if (!columns) return std::unexpected(columns.error());
  const auto time = find_time(*table, file);
  if (!time) return std::unexpected(time.error());
  const auto rec_column = table->find("rec");
  if (options.rec && !rec_column)
    return std::unexpected(std::string(file) + ":1: rec= is given but there is no column rec[1]");

  std::optional<double> rec = options.rec;
  std::string recs;
  std::optional<double> last_rec;
  double t_first = 0, t_last = 0;
  bool left = false;  // the selected recording has ended
  for (std::size_t row = 0; row < table->rows(); ++row) {
    if (rec_column) {
      const auto r = table->number(row, *rec_column);
      if (!r) return std::unexpected(r.error().text(file));
      if (!last_rec || *last_rec != *r) recs += (recs.empty() ? "" : ", ") + shown(*r);
      last_rec = *r;
      if (!rec) rec = *r;
      if (*r != *rec) {
        left = !motion.t_.empty();
        continue;
      }
      if (left) {
        return std::unexpected(std::string(file) + ":" + std::to_string(table->line(row)) + ": recording " +
                               shown(*rec) + " continues after another one");
      }
    }
    const auto stamp = table->number(row, time->index);
    if (!stamp) return std::unexpected(stamp.error().text(file));
    const double t = *stamp * time->unit;
    Vec3 x;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto cell = table->number(row, (*columns)[i]);
      if (!cell) return std::unexpected(cell.error().text(file));
      x[static_cast<int>(i)] = *cell * (table->columns()[(*columns)[i]].unit == "mm" ? 1e-3 : 1.0);
    }
    if (!(x.cwiseAbs().maxCoeff() < 1e6)) {
      return std::unexpected(std::string(file) + ":" + std::to_string(table->line(row)) + ": position beyond 1000 km");
    }
    if (motion.t_.empty()) {
      t_first = t_last = t;
      motion.t_.push_back(0.0);
      motion.x_.push_back(x);
      motion.line_.push_back(table->line(row));
      continue;
    }
    const auto at_row =
        std::string(file) + ":" + std::to_string(table->line(row)) + ": " + table->columns()[time->index].name + ": ";
    if (t < t_last) return std::unexpected(at_row + "time goes back from " + shown(t_last) + " to " + shown(t) + " s");
    if (t == t_last && x != motion.x_.back()) return std::unexpected(at_row + "two positions at " + shown(t) + " s");
    t_last = t;
    motion.t_.push_back(t - t_first);
    motion.x_.push_back(x);
    motion.line_.push_back(table->line(row));
  }
  if (motion.t_.size() < 2) {
    return std::unexpected(std::string(file) +
                           (options.rec ? ": rec=" + shown(*options.rec) : std::string(": the recording")) + " has " +
                           std::to_string(motion.t_.size()) + " rows, at least 2 are needed" +
                           (recs.empty() ? "" : "; recordings: " + recs));
  }
  motion.drop_repeats();
  if (motion.t_.size() < 2) return std::unexpected(std::string(file) + ": the recording has no duration");
  motion.fit(options);
  motion.make_tangents();
  return motion;
}

std::expected<RecordedMotion, std::string> RecordedMotion::from_points(std::vector<double> t, std::vector<Vec3> x) {
  if (t.size() < 2 || t.size() != x.size())
    return std::unexpected("a motion needs at least two points, and one position per time");
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i]) || !x[i].allFinite())
      return std::unexpected("point " + std::to_string(i) + " is not finite");
    if (i == 0 ? t[i] != 0.0 : t[i] <= t[i - 1])
      return std::unexpected("point " + std::to_string(i) + ": time must begin at 0 and ascend");
  }
  RecordedMotion motion;
  motion.line_.resize(t.size());
  std::iota(motion.line_.begin(), motion.line_.end(), std::size_t{1});
  motion.t_ = std::move(t);
  motion.x_ = std::move(x);
  motion.make_tangents();
  return motion;
}

void RecordedMotion::drop_repeats() {
  // A logger that runs faster than its source repeats positions, which would appear as a stop and a jump. Only the
  // first row of a short repetition is kept. A longer one is a real pause: both of its ends are kept.
  std::vector<double> t;
  std::vector<Vec3> x;
  std::vector<std::size_t> line;
  for (std::size_t i = 0; i < t_.size();) {
    std::size_t end = i + 1;
    while (end < t_.size() && x_[end] == x_[i]) ++end;
    t.push_back(t_[i]);
    x.push_back(x_[i]);
    line.push_back(line_[i]);
    const bool pause = t_[end - 1] - t_[i] > kRepeatMax || (end == t_.size() && t_[end - 1] > t_[i]);
    if (pause) {
      t.push_back(t_[end - 1]);
      x.push_back(x_[i]);
      line.push_back(line_[end - 1]);
    }
    i = end;
  }
  repeated_ = t_.size() - t.size();
  t_ = std::move(t);
  x_ = std::move(x);
  line_ = std::move(line);
}

void RecordedMotion::fit(const MotionOptions& options) {
  Vec3 low = x_.front(), high = x_.front();
  for (const Vec3& x : x_) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  middle_ = options.keep_middle ? Vec3::Zero() : Vec3(0.5 * (low + high));
  double farthest = 0;
  for (const Vec3& x : x_) farthest = std::max(farthest, (x - middle_).norm());
  scale_ = options.scale ? *options.scale : farthest > kReach ? kReach / farthest : 1.0;
  for (Vec3& x : x_) {
    const Vec3 centred = scale_ * (x - middle_);
    for (std::size_t i = 0; i < 3; ++i) x[static_cast<int>(i)] = options.axes[i].sign * centred[options.axes[i].from];
  }
  // Peak speed of a minimum-jerk move is 1.875 times its mean.
  back_ = std::max(kBackMin, 1.875 * (x_.back() - x_.front()).norm() / kBackSpeed);
}

void RecordedMotion::make_tangents() {
  const std::size_t n = t_.size();
  v_.assign(n, Vec3::Zero());
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t_[i] - t_[i - 1], after = t_[i + 1] - t_[i];
    const Vec3 slope_before = (x_[i] - x_[i - 1]) / before, slope_after = (x_[i + 1] - x_[i]) / after;
    v_[i] = (after * slope_before + before * slope_after) / (before + after);
    keep_between_ends(v_[i], slope_before, before, after);
    keep_between_ends(v_[i], slope_after, after, before);
  }
  v_[0] = (x_[1] - x_[0]) / (t_[1] - t_[0]);
  v_[n - 1] = (x_[n - 1] - x_[n - 2]) / (t_[n - 1] - t_[n - 2]);
}

MotionPoint RecordedMotion::at(double t, Cursor& cursor) const noexcept {
  if (!(t > 0.0)) return {x_.front(), Vec3::Zero()};
  const double end = t_.back();
  if (t >= end) {
    if (!loop_ || !std::isfinite(t)) return {x_.back(), Vec3::Zero()};
    t = std::fmod(t, end + back_);
    if (t >= end) {
      const MinJerk s = min_jerk((t - end) / back_);
      const Vec3 way = x_.front() - x_.back();
      return {x_.back() + s.value * way, s.rate / back_ * way};
    }
  }
  // The next interval is nearly always this one or the following one; otherwise it is searched.
  std::size_t i = std::min(cursor.i, t_.size() - 2);
  if (t >= t_[i + 1] && i + 2 < t_.size()) ++i;
  if (!(t_[i] <= t && t < t_[i + 1])) {
    const auto next = std::upper_bound(t_.begin(), t_.end(), t);
    i = std::clamp<std::size_t>(static_cast<std::size_t>(next - t_.begin()), 1, t_.size() - 1) - 1;
  }
  cursor.i = i;

  const double step = t_[i + 1] - t_[i];
  const double u = (t - t_[i]) / step, u2 = u * u;
  const double h01 = u2 * (3.0 - 2.0 * u), h10 = u * (1.0 - u) * (1.0 - u), h11 = u2 * (u - 1.0);
  const double d01 = 6.0 * u * (1.0 - u), d10 = (1.0 - u) * (1.0 - 3.0 * u), d11 = u * (3.0 * u - 2.0);
  const Vec3 way = x_[i + 1] - x_[i];
  return {x_[i] + h01 * way + step * (h10 * v_[i] + h11 * v_[i + 1]), d01 / step * way + d10 * v_[i] + d11 * v_[i + 1]};
}

std::optional<RecordedMotion::Beyond> RecordedMotion::first_beyond(double reach, double speed_max) const noexcept {
  for (std::size_t i = 0; i < x_.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(x_[i][axis]) <= reach)) return Beyond{line_[i], axis, x_[i][axis]};
    if (i == 0) continue;
    const double speed = (x_[i] - x_[i - 1]).norm() / (t_[i] - t_[i - 1]);
    if (!(speed <= speed_max)) return Beyond{line_[i], -1, speed};
  }
  return std::nullopt;
}

std::string RecordedMotion::describe() const {
  return "position" + (columns_.empty() ? "" : " " + columns_) + ", " + shown(duration()) + " s, " +
         std::to_string(rows()) + " positions (" + std::to_string(repeated_) + " repeated rows left out), scale " +
         shown(scale_);
}

}  // namespace tandem::hal::sim
