#include "server/archive/recording_row.h"

#include <algorithm>
#include <numeric>

namespace tandem::server {

namespace {

constexpr double kNanosecondsPerDay = 86400e9;

}  // namespace

void add_person(std::vector<RecordedPerson>& persons, const std::string& name, const std::string& part) {
  if (name.empty()) return;
  const RecordedPerson person{name, part};
  if (std::ranges::find(persons, person) == persons.end()) persons.push_back(person);
}

std::uint64_t missing_ticks_of(const Lesson& head, const LessonExtent& extent) {
  std::uint64_t missing = 0;
  if (extent.rows > 0) {
    const std::uint64_t span = std::uint64_t{extent.last_tick} - extent.first_tick + 1;
    missing = span - std::min<std::uint64_t>(span, extent.rows);
  }
  for (const auto& [topic, count] : head.counts) missing = std::max(missing, count.dropped);
  return missing;
}

RecordingSummary summary_of(const Lesson& lesson) {
  RecordingSummary out;
  out.session = lesson.session;
  out.scene = lesson.scene.name;
  out.start_unix_ns = lesson.start_unix_ns;
  // A recording may begin in the midst of its session.
  if (out.start_unix_ns != 0 && !lesson.time_ns.empty()) out.start_unix_ns += lesson.time_ns.front();
  out.rows = lesson.rows();
  out.complete = lesson.complete;
  if (!lesson.tick.empty()) {
    const std::uint64_t span = lesson.tick.back() - lesson.tick.front();
    out.duration_s = static_cast<double>(span) / lesson.scene.tick_hz;
  }
  out.missing_ticks = missing_ticks_of(lesson, extent_of(lesson));
  for (std::size_t i = 0; i < std::min(lesson.seats.size(), lesson.scene.seats.size()); ++i)
    add_person(out.persons, lesson.seats[i].person, lesson.scene.seats[i].name);
  for (const LessonMark& mark : lesson.marks) add_person(out.persons, mark.by, "notes");
  for (const LessonSheet& sheet : lesson.sheets) add_person(out.persons, sheet.by, "notes");
  if (auto part = read_part(lesson.metadata, "")) out.part = std::move(*part);
  return out;
}

std::vector<std::size_t> beyond_limits(const std::vector<RecordingRow>& rows, const RetentionLimits& limits,
                                       std::int64_t now_ns) {
  std::vector<std::size_t> by_age(rows.size());
  std::iota(by_age.begin(), by_age.end(), std::size_t{0});
  std::erase_if(by_age, [&](std::size_t k) { return !rows[k].readable(); });
  std::ranges::stable_sort(by_age, {}, [&](std::size_t k) { return rows[k].begun_ns(); });
  std::uint64_t kept = 0;
  for (const std::size_t k : by_age) kept += rows[k].bytes;
  std::vector<std::size_t> chosen;
  for (const std::size_t k : by_age) {
    const double age = static_cast<double>(now_ns - rows[k].begun_ns());
    const bool too_old = limits.days > 0 && age > limits.days * kNanosecondsPerDay;
    const bool too_many = limits.bytes > 0 && kept > limits.bytes;
    if (!too_old && !too_many) break;  // all later ones are younger
    chosen.push_back(k);
    kept -= rows[k].bytes;
  }
  return chosen;
}

std::vector<std::size_t> recordings_with(const std::vector<RecordingRow>& rows, const std::string& person) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (std::ranges::find(rows[k].summary.persons, person, &RecordedPerson::name) != rows[k].summary.persons.end())
      found.push_back(k);
  return found;
}

}  // namespace tandem::server
