#include "server/archive/recording_text.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "server/archive/recording_group.h"

namespace tandem::server {

namespace {

std::string time_text(std::int64_t unix_ns) {
  using namespace std::chrono;
  const sys_time<minutes> minute = floor<minutes>(sys_time<nanoseconds>(nanoseconds(unix_ns)));
  const sys_days day = floor<days>(minute);
  const year_month_day date(day);
  const hh_mm_ss time(minute - day);
  return format("%d-%02u-%02u %02lld:%02lld", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()), static_cast<long long>(time.hours().count()),
                static_cast<long long>(time.minutes().count()));
}

/// Begin as the file states it; recordings in virtual time do not.
std::string begin_text(const RecordingSummary& summary) {
  return summary.start_unix_ns == 0 ? "not stated" : time_text(summary.start_unix_ns);
}

std::string size_text(std::uint64_t bytes) { return format("%.1f MB", static_cast<double>(bytes) * 1e-6); }

std::string persons_text(const RecordingSummary& summary) {
  std::string text;
  for (const RecordedPerson& person : summary.persons)
    text += (text.empty() ? "" : ", ") + sanitize(person.name, 60) + " (" + sanitize(person.part, 40) + ")";
  return text.empty() ? "-" : text;
}

/// Place in a recording of several files; empty: it has one.
std::string part_text(const RecordedPart& part) {
  const bool alone = part.recording.empty() || (part.number == 1 && part.last.value_or(true));
  return alone ? std::string() : format("  (part %u)", part.number);
}

nlohmann::ordered_json row_json(const RecordingRow& row) {
  using Json = nlohmann::ordered_json;
  const RecordingSummary& s = row.summary;
  Json persons = Json::array();
  for (const RecordedPerson& person : s.persons) persons.push_back({{"name", person.name}, {"part", person.part}});
  return {{"file", row.file},
          {"bytes", row.bytes},
          {"modified_unix_ns", row.modified_ns},
          {"problem", row.readable() ? Json(nullptr) : Json(row.problem)},
          {"session", s.session},
          {"scene", s.scene},
          {"start_unix_ns", s.start_unix_ns == 0 ? Json(nullptr) : Json(s.start_unix_ns)},
          {"duration_s", s.duration_s},
          {"rows", s.rows},
          {"missing_ticks", s.missing_ticks},
          {"complete", s.complete},
          {"persons", std::move(persons)},
          {"recording", s.part.recording.empty() ? Json(nullptr) : Json(s.part.recording)},
          {"part", s.part.number},
          {"last_part", s.part.last ? Json(*s.part.last) : Json(nullptr)}};
}

}  // namespace

std::string recordings_text(const std::vector<RecordingRow>& rows, bool whole_folder,
                            const std::vector<std::string>& unfinished) {
  std::size_t width = 4, names = 7;
  for (const RecordingRow& row : rows) {
    width = std::max(width, sanitize(row.file).size());
    names = std::max(names, sanitize(row.summary.session, 32).size());
  }
  const int w = static_cast<int>(width), n = static_cast<int>(names);
  std::string text, damaged;
  std::uint64_t bytes = 0;
  std::size_t readable = 0;
  std::size_t recordings = 0;
  std::string incomplete;
  for (const RecordingGroup& group : group_recordings(rows, unfinished)) {
    if (whole_folder && !group.problem.empty()) incomplete += sanitize(group.problem) + "\n";
    if (whole_folder && group.grows)
      incomplete += sanitize(rows[group.rows.back()].file) + ": the next part of this recording is not closed yet\n";
    if (rows[group.rows.front()].readable()) ++recordings;
    for (const std::size_t k : group.rows) {
      const RecordingRow& row = rows[k];
      const std::string file = sanitize(row.file);
      if (!row.readable()) {
        damaged += file + ": skipped, " + sanitize(row.problem) + "\n";
        continue;
      }
      ++readable;
      bytes += row.bytes;
      text += format("%-*s  %16s  %9.1f s  %10s  %-*s  %s%s%s\n", w, file.c_str(), begin_text(row.summary).c_str(),
                     row.summary.duration_s, size_text(row.bytes).c_str(), n, sanitize(row.summary.session, 32).c_str(),
                     persons_text(row.summary).c_str(), part_text(row.summary.part).c_str(),
                     row.summary.rows == 0  ? "  (no tick: the session did not run)"
                     : row.summary.complete ? ""
                                            : "  (cut, damaged or repaired)");
    }
  }
  if (readable > 0)
    text.insert(0, format("%-*s  %16s  %11s  %10s  %-*s  %s\n", w, "file", "begin (UTC)", "duration", "size", n,
                          "session", "persons"));
  text += format("%zu recording%s, ", recordings, recordings == 1 ? "" : "s");
  if (readable != recordings) text += format("%zu files, ", readable);
  text += size_text(bytes);
  if (readable < rows.size()) text += format("; files that cannot be read: %zu", rows.size() - readable);
  return text + "\n" + incomplete + damaged;
}

std::string recording_text(const RecordingRow& row, const std::vector<std::string>& files, const std::string& problem) {
  const RecordingSummary& s = row.summary;
  std::string text = "file      " + sanitize(row.file) + "\n" + "size      " + size_text(row.bytes) + "\n";
  if (!row.readable()) return text + "skipped   " + sanitize(row.problem) + "\n";
  text += "session   " + sanitize(s.session) + "\n";
  text += "scene     " + sanitize(s.scene) + "\n";
  text += "begin     " + begin_text(s) + (s.start_unix_ns == 0 ? "" : " UTC") + "\n";
  text += format("duration  %.3f s\n", s.duration_s);
  text += format("ticks     %llu recorded, %llu not recorded\n", static_cast<unsigned long long>(s.rows),
                 static_cast<unsigned long long>(s.missing_ticks));
  text += std::string("whole     ") +
          (!s.complete        ? "no: the file was cut, damaged or repaired"
           : !problem.empty() ? "the file; not the recording"
                              : "yes") +
          "\n";
  if (files.size() > 1 || !problem.empty()) {
    text +=
        format("part      %u of a recording of %zu file%s:", s.part.number, files.size(), files.size() == 1 ? "" : "s");
    for (const std::string& file : files) text += " " + sanitize(file);
    text += "\n";
  }
  if (!problem.empty()) text += "missing   " + sanitize(problem) + "\n";
  return text + "persons   " + persons_text(s) + "\n";
}

std::string recordings_json(const std::vector<RecordingRow>& rows) {
  using Json = nlohmann::ordered_json;
  Json out = Json::array();
  for (const RecordingRow& row : rows) out.push_back(row_json(row));
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tandem::server
