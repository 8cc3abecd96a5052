#include "netsim/score/trace_lesson.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "netsim/score/parts.h"
#include "netsim/score/tracks.h"

namespace tandem::netsim::score {
namespace {

constexpr std::string_view kAxes = "xyz";

/// Returns the number of an axis in `name` = stem + axis, or 3.
std::size_t axis_after(std::string_view name, std::string_view stem) {
  if (name.size() != stem.size() + 1 || !name.starts_with(stem)) return 3;
  return std::min<std::size_t>(kAxes.find(name.back()), 3);
}

/// Returns the number in `name` = stem + digit, or `most`.
std::size_t number_after(std::string_view name, std::string_view stem, std::size_t most) {
  if (name.size() != stem.size() + 1 || !name.starts_with(stem) || name.back() < '0' || name.back() > '9') return most;
  return std::min<std::size_t>(static_cast<std::size_t>(name.back() - '0'), most);
}

/// As std::from_chars, which decides about all texts but `-?DIGITS[.DIGITS]` of at most 15 digits. Such a number is the
/// quotient of two integers that a double holds exactly, so the result is the same: the nearest double. A trace has few
/// other numbers, and this takes a third of the instructions.
std::from_chars_result parsed(const char* const begin, const char* const end, double& value) {
  constexpr double kPowers[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  constexpr int kDigitsMax = 15;
  const char* at = begin;
  const bool negative = at != end && *at == '-';
  at += negative ? 1 : 0;
  std::int64_t number = 0;
  int digits = 0, decimals = 0;
  bool point = false;
  for (; at != end && digits <= kDigitsMax; ++at) {
    const auto digit = static_cast<unsigned>(*at) - '0';
    if (digit <= 9) {
      number = number * 10 + digit;
      ++digits;
      decimals += point ? 1 : 0;
    } else if (*at == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (digits == 0 || digits > kDigitsMax || (at != end && *at != ',')) return std::from_chars(begin, end, value);
  value = static_cast<double>(number) / kPowers[decimals];
  if (negative) value = -value;
  return {at, std::errc{}};
}

bool any(const auto& columns) {
  return std::ranges::any_of(columns, [](std::size_t c) { return c != ~std::size_t{0}; });
}

}  // namespace

TraceReader::TraceReader(SceneSpec scene, std::string file) : file_(std::move(file)) {
  seats_.resize(scene.seats.size());
  tools_.resize(scene.tools.size());
  lesson_.session = scene.name;
  lesson_.seats.resize(scene.seats.size());
  lesson_.tools.resize(scene.tools.size());
  lesson_.scene = std::move(scene);
}

std::unexpected<std::string> TraceReader::error(const std::string& what) const {
  return std::unexpected(file_ + ":" + std::to_string(line_) + ": " + what);
}

std::unexpected<std::string> TraceReader::error_at(std::size_t column, const std::string& what) const {
  return error("column " + names_[column] + ": " + what);
}

std::expected<void, std::string> TraceReader::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    if (rest_.size() + std::min(end, bytes.size()) > kLineMax) {
      ++line_;
      return error("the line is longer than " + std::to_string(kLineMax) + " bytes; this is no trace");
    }
    if (end == std::string_view::npos) {
      rest_ += bytes;
      return {};
    }
    if (rest_.empty()) {
      if (auto done = line(bytes.substr(0, end)); !done) return done;
    } else {
      rest_ += bytes.substr(0, end);
      const std::string whole = std::exchange(rest_, {});
      if (auto done = line(whole); !done) return done;
    }
    bytes.remove_prefix(end + 1);
  }
  return {};
}

std::expected<void, std::string> TraceReader::line(std::string_view text) {
  ++line_;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return names_.empty() ? header(text) : row(text);
}

std::size_t* TraceReader::place_of(std::string_view name, std::string_view unit) {
  const auto matches = [&](std::string_view wanted, std::string_view of_unit) {
    return name == wanted && unit == of_unit;
  };
  if (matches("tick", "1")) return &tick_;
  if (matches("t_s", "s")) return &time_;
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return nullptr;
  const std::string_view of = name.substr(0, dot);
  name.remove_prefix(dot + 1);
  const auto three = [&](Three& columns, std::string_view stem, std::string_view of_unit) -> std::size_t* {
    const std::size_t axis = axis_after(name, stem);
    return axis < 3 && unit == of_unit ? &columns[axis] : nullptr;
  };
  const auto axes = [&](auto& columns, std::string_view stem, std::string_view of_unit) -> std::size_t* {
    const std::size_t axis = number_after(name, stem, columns.size());
    return axis < columns.size() && unit == of_unit ? &columns[axis] : nullptr;
  };
  const auto first = [](std::initializer_list<std::size_t*> places) {
    const auto* const found = std::ranges::find_if(places, [](const std::size_t* p) { return p != nullptr; });
    return found == places.end() ? nullptr : *found;
  };
  const auto& seats = lesson_.scene.seats;
  if (const auto seat = std::ranges::find(seats, of, &SeatSpec::name); seat != seats.end()) {
    SeatColumns& c = seats_[static_cast<std::size_t>(seat - seats.begin())];
    if (matches("alpha", "1")) return &c.alpha;
    if (matches("leader", "1")) return &c.leader;
    return first({three(c.x, "", "m"), three(c.f_cmd, "f_cmd_", "N"), three(c.f_out, "f_out_", "N"),
                  three(c.ghost, "ghost_", "m"), axes(c.q, "q", "rad"), axes(c.q, "q", "m"), axes(c.e_in, "e_in", "nJ"),
                  axes(c.e_out, "e_out", "nJ")});
  }
  const auto& tools = lesson_.scene.tools;
  const auto tool = std::ranges::find(tools, of, &ToolSpec::name);
  if (tool == tools.end()) return nullptr;
  ToolColumns& c = tools_[static_cast<std::size_t>(tool - tools.begin())];
  if (matches("penetration", "m")) return &c.penetration;
  if (matches("held", "1")) return &c.held;
  return first({three(c.x, "", "m"), three(c.f_cmd, "f_cmd_", "N"), three(c.f_env, "f_env_", "N"),
                axes(c.q, "q", "rad"), axes(c.q, "q", "m"), axes(c.e_p, "e_p", "J")});
}

std::expected<void, std::string> TraceReader::header(std::string_view text) {
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string_view cell = text.substr(0, comma);
    const std::size_t bracket = cell.find('[');
    names_.emplace_back(cell);
    const std::size_t number = names_.size() - 1;
    if (bracket == std::string_view::npos || !cell.ends_with(']'))
      return error("column " + std::to_string(number + 1) + ": \"" + std::string(cell) +
                   "\" is not NAME[UNIT]; the first line of a trace names its columns");
    const std::string_view unit = cell.substr(bracket + 1, cell.size() - bracket - 2);
    std::size_t* const place = place_of(cell.substr(0, bracket), unit);
    if (place == nullptr)
      return error("column " + std::string(cell) + ": scene " + lesson_.scene.name +
                   " has no such seat, tool, value or unit; name the scene of this trace with --scene");
    if (*place != kNone) return error_at(number, "occurs twice");
    *place = number;
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (tick_ == kNone) return error("the column tick[1] is missing; this is no trace");
  const auto complete = [](const Three& c) { return c[0] != kNone && c[1] != kNone && c[2] != kNone; };
  bool master = false;
  for (std::size_t i = 0; i < seats_.size(); ++i)
    master = master || (lesson_.scene.seats[i].kind == SeatKind::kMaster && complete(seats_[i].x));
  if (!master) return error("no MASTER seat of scene " + lesson_.scene.name + " has its columns x[m], y[m] and z[m]");
  cells_.resize(names_.size());
  return {};
}

std::expected<void, std::string> TraceReader::row(std::string_view text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto [stop, problem] = parsed(at, end, cells_[c]);
    if (problem != std::errc{} || (stop != end && *stop != ',')) {
      const std::string_view cell(at, static_cast<std::size_t>(std::find(at, end, ',') - at));
      return error_at(c, at == end && c > 0 ? "the line ends before it"
                                            : "\"" + std::string(cell.substr(0, 40)) + "\" is not a number");
    }
    const bool last = c + 1 == cells_.size();
    if (last != (stop == end))
      return error(last ? "has more cells than the first line, " + std::to_string(cells_.size())
                        : "has " + std::to_string(c + 1) + " cells; the first line has " +
                              std::to_string(cells_.size()));
    at = stop + (last ? 0 : 1);
  }
  const double tick = cells_[tick_];
  if (!(tick >= 0 && tick <= 4294967295.0) || tick != std::floor(tick))
    return error_at(tick_, "must be an integer in [0, 4294967295]");
  if (!lesson_.tick.empty() && tick <= lesson_.tick.back()) {
    if (tick == lesson_.tick.back()) return {};
    return error_at(tick_, std::to_string(static_cast<std::uint32_t>(tick)) + " is below the tick before, " +
                               std::to_string(lesson_.tick.back()));
  }
  if (lesson_.rows() >= kRowsMax) return error("more than " + std::to_string(kRowsMax) + " rows; cut the trace");
  store_row();
  return {};
}

void TraceReader::store_row() {
  const auto value = [&](std::size_t c) { return c == kNone ? kUnknown : cells_[c]; };
  const auto three = [&](const Three& c, std::vector<LessonTriple>& to) {
    if (any(c)) to.push_back({value(c[0]), value(c[1]), value(c[2])});
  };
  const auto one = [&](std::size_t c, std::vector<double>& to) {
    if (c != kNone) to.push_back(cells_[c]);
  };
  const auto whole = [&](std::size_t c) {
    return c != kNone && cells_[c] > 0 && cells_[c] < 1.8e19 ? static_cast<std::uint64_t>(cells_[c]) : 0;
  };
  const auto joints = [&](const auto& c, std::vector<AxisArray>& to) {
    if (!any(c)) return;
    AxisArray& q = to.emplace_back();
    for (std::size_t j = 0; j < q.size(); ++j) q[j] = c[j] == kNone ? 0 : cells_[c[j]];
  };
  const auto energies = [&](const auto& c, std::vector<EnergyArray>& to) {
    if (!any(c)) return;
    EnergyArray& e = to.emplace_back();
    for (std::size_t a = 0; a < e.size(); ++a) e[a] = whole(c[a]);
  };
  lesson_.tick.push_back(static_cast<std::uint32_t>(cells_[tick_]));
  const double time = time_ == kNone ? lesson_.tick.back() / lesson_.scene.tick_hz : cells_[time_];
  lesson_.time_ns.push_back(std::abs(time) < 9e9 ? std::llround(time * 1e9) : 0);
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const SeatColumns& c = seats_[i];
    LessonSeat& seat = lesson_.seats[i];
    one(c.alpha, seat.alpha);
    joints(c.q, seat.q);
    three(c.x, seat.x);
    three(c.f_cmd, seat.f_cmd);
    three(c.f_out, seat.f);
    energies(c.e_in, seat.e_in);
    energies(c.e_out, seat.e_out);
    if (c.leader != kNone)
      seat.leader.push_back(static_cast<std::uint32_t>(std::min<std::uint64_t>(whole(c.leader), kMastersMax)));
    three(c.ghost, seat.ghost);
  }
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const ToolColumns& c = tools_[i];
    LessonTool& tool = lesson_.tools[i];
    joints(c.q, tool.q);
    three(c.x, tool.x);
    three(c.f_cmd, tool.f_cmd);
    three(c.f_env, tool.f_env);
    one(c.penetration, tool.penetration);
    if (c.held != kNone) tool.held.push_back(whole(c.held) != 0 ? 1 : 0);
    if (any(c.e_p)) tool.e_p_axis_j.push_back({value(c.e_p[0]), value(c.e_p[1]), value(c.e_p[2])});
  }
}

std::expected<Lesson, std::string> TraceReader::finish() {
  if (names_.empty()) return error("the file is empty; a trace begins with the names of its columns");
  if (!rest_.empty()) {
    // The last line of a trace ends with a line feed; a cut one is not a row.
    lesson_.complete = false;
    rest_.clear();
  }
  if (lesson_.rows() == 0) return error("the trace has no row");
  return std::move(lesson_);
}

}  // namespace tandem::netsim::score
