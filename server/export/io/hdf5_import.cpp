#include "server/export/io/hdf5_import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "proto/spec/input_error.h"
#include "proto/text/scene_text.h"
#include "server/export/io/hdf5_export.h"
#include "server/export/io/hdf5_input.h"
#include "server/export/io/hdf5_library.h"
#include "server/export/io/trial_process.h"
#include "server/export/lesson_records.h"
#include "server/export/lesson_signals.h"

namespace tandem::server {

namespace {

constexpr std::uint64_t kFileMax = std::uint64_t{1} << 32;  // [bytes]
// Processor time of a trial: reading takes a tenth of it.
constexpr std::uint64_t kTrialSeconds = 5, kTrialBytesPerSecond = 5'000'000;
constexpr std::int64_t kCountMax = std::numeric_limits<std::uint32_t>::max();

/// Returns the number whose quotient by `divisor` is `quotient`. Division rounds, so the product may be off by one
/// step.
double undivided(double quotient, double divisor) {
  const double product = quotient * divisor;
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  for (const double near : {product, std::nextafter(product, -kEnd), std::nextafter(product, kEnd)})
    if (near / divisor == quotient) return near;
  return product;
}

/// One real number per element of a list.
template <class Row, class Set>
void read_reals(Hdf5Input& in, const std::string& path, std::vector<Row>& rows, Set set) {
  in.real(path, rows.size(), 0, [&](std::size_t first, std::span<const double> from) {
    for (std::size_t k = 0; k < from.size(); ++k) set(rows[first + k], from[k]);
  });
}

/// One whole number per element of a list, in [min, max].
template <class Row, class Set>
void read_wholes(Hdf5Input& in, const std::string& path, std::int64_t min, std::int64_t max, std::vector<Row>& rows,
                 Set set) {
  in.whole(path, rows.size(), 0, [&](std::size_t first, std::span<const std::int64_t> from) {
    for (std::size_t k = 0; k < from.size(); ++k) {
      if (from[k] < min || from[k] > max)
        return in.fail("dataset " + path,
                       format("row %zu is %lld; allowed are %lld to %lld", first + k, static_cast<long long>(from[k]),
                              static_cast<long long>(min), static_cast<long long>(max)));
      set(rows[first + k], from[k]);
    }
  });
}

template <class Row, class Set>
void read_texts(Hdf5Input& in, const std::string& path, std::vector<Row>& rows, Set set) {
  std::vector<std::string> texts = in.texts(path, rows.size());
  for (std::size_t k = 0; k < texts.size(); ++k) set(rows[k], std::move(texts[k]));
}

void read_metadata(Hdf5Input& in, Lesson& lesson) {
  const std::string found = in.text_attribute("/", "format");
  if (in.good() && found != kHdf5Format)
    in.fail("", "is an HDF5 file, but no recording of Tandem: its attribute format is \"" + sanitize(found, 64) +
                    "\", not \"" + std::string(kHdf5Format) + "\"");
  lesson.session = in.text_attribute("/", "session");
  lesson.start_unix_ns = in.whole_attribute("/", "start_unix_ns");
  if (lesson.start_unix_ns < 0) in.fail("attribute start_unix_ns of /", "is negative");
  lesson.complete = in.whole_attribute("/", "complete") != 0;
  for (const std::string& key : in.attributes("/metadata")) lesson.metadata[key] = in.text_attribute("/metadata", key);
  const std::vector<std::string> scene = in.texts("/scene", 1);
  const std::string name = in.text_attribute("/scene", "name");
  const double duration = in.real_attribute("/scene", "duration");
  if (!in.good()) return;
  lesson.scene_text = scene.front();
  auto parsed = parse_scene(lesson.scene_text, name + ".textproto");
  if (!parsed) return in.fail("dataset /scene", "is not valid: " + sanitize(to_text(parsed.error())));
  if (!(duration > 0)) return in.fail("attribute duration of /scene", format("is %g s; it must be above 0", duration));
  lesson.scene = std::move(*parsed);
  lesson.scene.duration = duration;  // an option of the session may have shortened that of the text
  if (const double rate = in.real_attribute("/", "tick_hz"); in.good() && rate != lesson.scene.tick_hz)
    in.fail("attribute tick_hz of /", format("is %g Hz; the scene has %g Hz", rate, lesson.scene.tick_hz));
  lesson.seats.resize(lesson.scene.seats.size());
  lesson.tools.resize(lesson.scene.tools.size());
  for (std::size_t i = 0; i < lesson.seats.size(); ++i)
    lesson.seats[i].person = in.text_attribute("/seats/" + lesson.scene.seats[i].name, "person");
}

void read_whole_signal(Hdf5Input& in, const LessonSignal& signal, const std::string& path, std::size_t rows) {
  const std::size_t width = signal.width();
  in.whole(path, rows, signal.columns.size(), [&](std::size_t first, std::span<const std::int64_t> from) {
    for (std::size_t k = 0; k < from.size(); ++k)
      if (from[k] < signal.whole_min || from[k] > signal.whole_max)
        return in.fail(
            "dataset " + path,
            format("row %zu is %lld; allowed are %lld to %lld", first + k / width, static_cast<long long>(from[k]),
                   static_cast<long long>(signal.whole_min), static_cast<long long>(signal.whole_max)));
    for (std::size_t k = 0; k < from.size(); k += width) signal.set_whole(first + k / width, from.subspan(k, width));
  });
}

void read_real_signal(Hdf5Input& in, const LessonSignal& signal, const std::string& path, std::size_t rows) {
  const std::size_t width = signal.width();
  in.real(path, rows, signal.columns.size(), [&](std::size_t first, std::span<const double> from) {
    for (std::size_t k = 0; k < from.size() && std::isfinite(signal.real_max); ++k)
      if (!(std::abs(from[k]) <= signal.real_max))
        return in.fail("dataset " + path, format("row %zu is %g; allowed are %g to %g", first + k / width, from[k],
                                                 -signal.real_max, signal.real_max));
    for (std::size_t k = 0; k < from.size(); k += width) signal.set_real(first + k / width, from.subspan(k, width));
  });
}

void read_signals(Hdf5Input& in, Lesson& lesson) {
  const std::size_t rows = in.rows("/session/tick", 0);
  if (in.good() && rows == 0) in.fail("dataset /session/tick", "has no rows");
  for (const LessonSignal& signal : signals_to_read(lesson)) {
    if (!in.good()) return;
    const std::string path = "/" + signal.group + "/" + signal.name;
    if (!signal.resize) {
      in.check_real(path, rows);
      continue;
    }
    signal.resize(rows);
    (signal.set_real ? read_real_signal : read_whole_signal)(in, signal, path, rows);
  }
  for (std::size_t k = 1; in.good() && k < rows; ++k)
    if (lesson.tick[k] <= lesson.tick[k - 1])
      in.fail("dataset /session/tick",
              format("row %zu is %u after %u; ticks must increase", k, lesson.tick[k], lesson.tick[k - 1]));
}

void read_gaps(Hdf5Input& in, const Lesson& lesson) {
  const std::size_t rows = in.rows("/gaps", 2);
  if (!in.good()) return;
  const std::vector<LessonGap> gaps = gaps_of(lesson);
  if (rows != gaps.size())
    return in.fail("dataset /gaps", format("has %zu rows, but the ticks have %zu gaps", rows, gaps.size()));
  in.whole("/gaps", rows, 2, [&](std::size_t first, std::span<const std::int64_t> from) {
    for (std::size_t k = 0; 2 * k < from.size(); ++k)
      if (const LessonGap& gap = gaps[first + k]; from[2 * k] != gap.first || from[2 * k + 1] != gap.ticks)
        return in.fail("dataset /gaps", format("row %zu is %lld, %lld; the ticks have the gap %u, %u", first + k,
                                               static_cast<long long>(from[2 * k]),
                                               static_cast<long long>(from[2 * k + 1]), gap.first, gap.ticks));
  });
}

void read_links(Hdf5Input& in, Lesson& lesson) {
  std::vector<LessonLink>& links = lesson.links;
  links.resize(in.rows("/links/tick", 0));
  const auto count = [&](const char* name, std::uint32_t LessonLink::* member, std::int64_t max) {
    read_wholes(in, std::string("/links/") + name, 0, max, links,
                [member](LessonLink& l, std::int64_t value) { l.*member = static_cast<std::uint32_t>(value); });
  };
  const auto real = [&](const char* name, double LessonLink::* member, double divisor) {
    read_reals(in, std::string("/links/") + name, links,
               [member, divisor](LessonLink& l, double value) { l.*member = undivided(value, divisor); });
  };
  count("tick", &LessonLink::tick, kCountMax);
  count("seat", &LessonLink::seat, static_cast<std::int64_t>(lesson.seats.size()) - 1);
  real("rtt_p50", &LessonLink::rtt_p50_ms, kMillisecondsPerSecond);
  real("loss_up", &LessonLink::loss_up_percent, kPercent);
  real("loss_down", &LessonLink::loss_down_percent, kPercent);
  real("gap_up", &LessonLink::gap_up_ms, kMillisecondsPerSecond);
  real("gap_down", &LessonLink::gap_down_ms, kMillisecondsPerSecond);
  real("age_p99", &LessonLink::age_p99_ms, kMillisecondsPerSecond);
  count("gate_trips", &LessonLink::gate_trips, kCountMax);
  count("late_ticks", &LessonLink::late_ticks, kCountMax);
}

void read_notes(Hdf5Input& in, Lesson& lesson) {
  lesson.events.resize(in.rows("/events/tick", 0));
  read_wholes(in, "/events/tick", 0, kCountMax, lesson.events,
              [](LessonEvent& e, std::int64_t value) { e.tick = static_cast<std::uint32_t>(value); });
  read_wholes(in, "/events/time_ns", std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(),
              lesson.events, [](LessonEvent& e, std::int64_t value) { e.time_ns = value; });
  read_texts(in, "/events/what", lesson.events, [](auto& e, std::string text) { e.what = std::move(text); });
  read_texts(in, "/events/seat", lesson.events, [](auto& e, std::string text) { e.seat = std::move(text); });
  read_texts(in, "/events/text", lesson.events, [](auto& e, std::string text) { e.text = std::move(text); });
  lesson.marks.resize(in.rows("/marks/time", 0));
  read_reals(in, "/marks/time", lesson.marks, [](LessonMark& m, double value) { m.t_s = value; });
  read_texts(in, "/marks/by", lesson.marks, [](auto& m, std::string text) { m.by = std::move(text); });
  read_texts(in, "/marks/text", lesson.marks, [](auto& m, std::string text) { m.text = std::move(text); });
  for (const std::string& text : in.texts("/sheets")) {
    LessonSheet& sheet = lesson.sheets.emplace_back();
    try {
      const auto json = nlohmann::json::parse(text);
      json.at("sheet").get_to(sheet.sheet);
      json.at("of").get_to(sheet.of);
      json.at("by").get_to(sheet.by);
      json.at("scores").get_to(sheet.scores);
      json.at("closed").get_to(sheet.closed);
    } catch (const nlohmann::json::exception&) {
      return in.fail("dataset /sheets",
                     format("row %zu is no rating sheet: ", lesson.sheets.size() - 1) + sanitize(text, 80));
    }
  }
}

void read_counts(Hdf5Input& in, Lesson& lesson) {
  const std::vector<std::string> topics = in.texts("/channels/topic");
  std::vector<LessonCount> counts(topics.size());
  const auto column = [&](const char* name, std::uint64_t LessonCount::* member) {
    read_wholes(in, std::string("/channels/") + name, 0, std::numeric_limits<std::int64_t>::max(), counts,
                [member](LessonCount& c, std::int64_t value) { c.*member = static_cast<std::uint64_t>(value); });
  };
  column("recorded", &LessonCount::recorded);
  column("dropped", &LessonCount::dropped);
  column("never_received", &LessonCount::never_received);
  for (std::size_t k = 0; k < topics.size(); ++k) lesson.counts[topics[k]] = counts[k];
}

void read_lesson_file(Hdf5Input& in, Lesson& lesson) {
  read_metadata(in, lesson);
  read_signals(in, lesson);
  read_gaps(in, lesson);
  read_links(in, lesson);
  read_notes(in, lesson);
  read_counts(in, lesson);
}

/// Returns why a trial in a child process fails; empty: libhdf5 reads the file without a crash, and it is a lesson.
std::string trial_problem(const std::string& file, std::uint64_t bytes) {
  const auto attempt = [&file] {
    Hdf5Input in(file);
    Lesson lesson;
    read_lesson_file(in, lesson);
    return in.error();
  };
  std::string problem = try_in_child(attempt, static_cast<unsigned>(kTrialSeconds + bytes / kTrialBytesPerSecond));
  if (problem.empty() || problem.starts_with(file)) return problem;
  return file + ": " + problem + "; the file may be damaged: " + kHdf5NextStep;
}

}  // namespace

std::expected<Lesson, std::string> import_hdf5(const std::string& file) {
  std::error_code code;
  const std::uint64_t bytes = std::filesystem::file_size(file, code);
  if (code) return std::unexpected(file + ": " + code.message());
  if (bytes > kFileMax)
    return std::unexpected(file + ": more than " + std::to_string(kFileMax >> 30) + " GiB; cut the recording");
  if (const auto& library = Hdf5Library::load(); !library) return std::unexpected(file + ": " + library.error());
  if (std::string problem = trial_problem(file, bytes); !problem.empty()) return std::unexpected(std::move(problem));
  Hdf5Input in(file);
  Lesson lesson;
  read_lesson_file(in, lesson);
  if (!in.good()) return std::unexpected(in.error());
  return lesson;
}

}  // namespace tandem::server
