#include "server/export/io/hdf5_export.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/export/io/hdf5_file.h"
#include "server/export/lesson_records.h"
#include "server/export/lesson_signals.h"

namespace tandem::server {

namespace {

void describe(Hdf5File& file, const std::string& path, const std::string& unit, const std::string& frame,
              const std::string& description) {
  file.attribute(path, "unit", unit);
  file.attribute(path, "frame", frame);
  file.attribute(path, "description", description);
}

/// The datasets of the signals, which grow as the rows come.
class SignalDatasets {
 public:
  /// @param rows  of the whole lesson
  SignalDatasets(Hdf5File& file, const std::vector<LessonSignal>& signals, std::size_t rows) : file_(&file) {
    for (const LessonSignal& signal : signals) {
      const std::string path = "/" + signal.group + "/" + signal.name;
      reals_.push_back(signal.real ? file.begin_real(path, rows, signal.columns.size()) : Hdf5File::Dataset<double>{});
      wholes_.push_back(signal.real ? Hdf5File::Dataset<std::int64_t>{}
                                    : file.begin_whole(path, rows, signal.columns.size()));
      describe(file, path, signal.unit, signal.frame, signal.description);
      if (!signal.columns.empty()) file.attribute(path, "columns", signal.columns);
    }
  }

  /// Writes the next rows of signal `k`.
  /// @param first  number of the first of them in the whole lesson
  void put(std::size_t k, const LessonSignal& signal, std::size_t first, std::size_t rows) {
    if (signal.real) {
      put(reals_[k], signal.real, signal.width(), first, rows, real_);
    } else {
      put(wholes_[k], signal.whole, signal.width(), first, rows, whole_);
    }
  }

 private:
  template <class Number, class Source>
  void put(Hdf5File::Dataset<Number> to, const Source& source, std::size_t width, std::size_t first, std::size_t rows,
           std::vector<Number>& buffer) {
    for (std::size_t begin = 0; begin < rows && file_->error().empty(); begin += Hdf5File::kChunkRows) {
      const std::size_t count = std::min(Hdf5File::kChunkRows, rows - begin);
      buffer.resize(count * width);
      for (std::size_t row = 0; row < count; ++row) source(begin + row, std::span(buffer).subspan(row * width, width));
      file_->put(to, first + begin, count, std::span<const Number>(buffer));
    }
  }

  Hdf5File* file_;
  std::vector<Hdf5File::Dataset<double>> reals_;
  std::vector<Hdf5File::Dataset<std::int64_t>> wholes_;
  std::vector<double> real_;
  std::vector<std::int64_t> whole_;
};

/// Writes all rows. @return the error of the source, or of the user's end; errors of the file are in the file
std::string write_rows(Hdf5File& file, LessonSource& lesson, GapFinder& gaps, const ExportProgress& progress) {
  const std::size_t all = lesson.extent().rows;
  SignalDatasets datasets(file, signals_of(lesson.head()), all);
  std::size_t done = 0;
  while (file.error().empty()) {
    const auto piece = lesson.next();
    if (!piece) return piece.error();
    if (*piece == nullptr) break;
    const Lesson& rows = **piece;
    gaps.add(rows);
    const std::vector<LessonSignal> signals = signals_of(rows);
    for (std::size_t k = 0; k < signals.size() && file.error().empty(); ++k) {
      datasets.put(k, signals[k], done, rows.rows());
      const double of_piece = static_cast<double>(k + 1) / static_cast<double>(signals.size());
      if (!progress((static_cast<double>(done) + of_piece * static_cast<double>(rows.rows())) /
                    static_cast<double>(all)))
        return kExportInterrupted;
    }
    done += rows.rows();
  }
  return {};
}

/// One dataset with one number per element of a list.
template <class Row, class Value>
void write_column(Hdf5File& file, const std::string& path, const char* unit, const char* description,
                  const std::vector<Row>& rows, Value value) {
  using Number = decltype(value(rows.front()));
  const auto source = [&rows, &value](std::size_t first, std::size_t count, std::span<Number> to) {
    for (std::size_t k = 0; k < count; ++k) to[k] = value(rows[first + k]);
  };
  if constexpr (std::is_same_v<Number, double>) {
    file.real(path, rows.size(), 0, source);
  } else {
    file.whole(path, rows.size(), 0, source);
  }
  describe(file, path, unit, "none", description);
}

template <class Row, class Text>
void write_texts(Hdf5File& file, const std::string& path, const char* description, const std::vector<Row>& rows,
                 Text text) {
  std::vector<std::string> texts;
  for (const Row& row : rows) texts.push_back(text(row));
  file.texts(path, texts);
  file.attribute(path, "description", std::string(description));
}

void write_gaps(Hdf5File& file, const std::vector<LessonGap>& gaps) {
  file.whole("/gaps", gaps.size(), 2, [&gaps](std::size_t first, std::size_t count, std::span<std::int64_t> to) {
    for (std::size_t k = 0; k < count; ++k) {
      to[2 * k] = gaps[first + k].first;
      to[2 * k + 1] = gaps[first + k].ticks;
    }
  });
  describe(file, "/gaps", "1", "none", "ticks of the session without a row");
  file.attribute("/gaps", "columns", std::vector<std::string>{"first_tick", "ticks"});
}

void write_links(Hdf5File& file, const Lesson& lesson) {
  file.group("/links");
  const auto column = [&](const char* name, const char* unit, const char* description, auto value) {
    write_column(file, std::string("/links/") + name, unit, description, lesson.links, value);
  };
  const auto seconds = [](double ms) { return ms / kMillisecondsPerSecond; };
  column("tick", "1", "session tick", [](const LessonLink& l) { return std::int64_t{l.tick}; });
  column("seat", "1", "index of the seat, from 0", [](const LessonLink& l) { return std::int64_t{l.seat}; });
  column("rtt_p50", "s", "median round trip", [&](const LessonLink& l) { return seconds(l.rtt_p50_ms); });
  column("loss_up", "1", "share of lost datagrams to the server",
         [](const LessonLink& l) { return l.loss_up_percent / kPercent; });
  column("loss_down", "1", "share of lost datagrams to the client",
         [](const LessonLink& l) { return l.loss_down_percent / kPercent; });
  column("gap_up", "s", "longest gap to the server", [&](const LessonLink& l) { return seconds(l.gap_up_ms); });
  column("gap_down", "s", "longest gap to the client", [&](const LessonLink& l) { return seconds(l.gap_down_ms); });
  column("age_p99", "s", "99th percentile of the age of samples",
         [&](const LessonLink& l) { return seconds(l.age_p99_ms); });
  column("gate_trips", "1", "trips of the force gate so far",
         [](const LessonLink& l) { return std::int64_t{l.gate_trips}; });
  column("late_ticks", "1", "late ticks of the device's thread so far",
         [](const LessonLink& l) { return std::int64_t{l.late_ticks}; });
}

void write_notes(Hdf5File& file, const Lesson& lesson) {
  for (const char* group : {"/events", "/marks"}) file.group(group);
  write_column(file, "/events/tick", "1", "session tick", lesson.events,
               [](const LessonEvent& e) { return std::int64_t{e.tick}; });
  write_column(file, "/events/time_ns", "ns", "monotonic clock of the server since the first tick", lesson.events,
               [](const LessonEvent& e) { return e.time_ns; });
  write_texts(file, "/events/what", "word of the audit log", lesson.events, [](const auto& e) { return e.what; });
  write_texts(file, "/events/seat", "name of the seat, or empty", lesson.events, [](const auto& e) { return e.seat; });
  write_texts(file, "/events/text", "line for users", lesson.events, [](const auto& e) { return e.text; });
  write_texts(file, "/events/person", "person that gave the order at a console, or empty", lesson.events,
              [](const auto& e) { return e.person; });
  write_column(file, "/marks/time", "s", "session time", lesson.marks, [](const LessonMark& m) { return m.t_s; });
  write_texts(file, "/marks/by", "author", lesson.marks, [](const auto& m) { return m.by; });
  write_texts(file, "/marks/text", "text of the mark", lesson.marks, [](const auto& m) { return m.text; });
  write_texts(file, "/sheets", "rating sheets, each as JSON", lesson.sheets, [](const LessonSheet& s) {
    const nlohmann::ordered_json json{
        {"sheet", s.sheet}, {"of", s.of}, {"by", s.by}, {"scores", s.scores}, {"closed", s.closed}};
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  });
}

void write_counts(Hdf5File& file, const Lesson& lesson) {
  const std::vector<std::pair<std::string, LessonCount>> counts(lesson.counts.begin(), lesson.counts.end());
  file.group("/channels");
  file.attribute("/channels", "description", std::string("recorded + dropped + never_received = ticks of the session"));
  write_texts(file, "/channels/topic", "topic in the recording", counts, [](const auto& c) { return c.first; });
  write_column(file, "/channels/recorded", "1", "recorded messages", counts,
               [](const auto& c) { return static_cast<std::int64_t>(c.second.recorded); });
  write_column(file, "/channels/dropped", "1", "messages that the recorder dropped", counts,
               [](const auto& c) { return static_cast<std::int64_t>(c.second.dropped); });
  write_column(file, "/channels/never_received", "1", "messages that never arrived", counts,
               [](const auto& c) { return static_cast<std::int64_t>(c.second.never_received); });
}

void write_metadata(Hdf5File& file, const Lesson& lesson) {
  file.attribute("/", "format", std::string(kHdf5Format));
  file.attribute("/", "session", lesson.session);
  file.attribute("/", "tick_hz", lesson.scene.tick_hz);
  file.attribute("/", "start_unix_ns", lesson.start_unix_ns);
  file.attribute("/", "complete", std::int64_t{lesson.complete ? 1 : 0});
  file.group("/metadata");
  for (const auto& [key, value] : lesson.metadata)
    if (!key.empty()) file.attribute("/metadata", key, value);
  file.texts("/scene", {lesson.scene_text});
  file.attribute("/scene", "description", std::string("scene with all effective values, as text"));
  file.attribute("/scene", "name", lesson.scene.name);
  file.attribute("/scene", "duration", lesson.scene.duration);
}

void write_groups(Hdf5File& file, const Lesson& lesson) {
  for (const char* group : {"/session", "/seats", "/tools"}) file.group(group);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) {
    const std::string path = "/seats/" + lesson.scene.seats[i].name;
    file.group(path);
    file.attribute(path, "person", lesson.seats[i].person);
    file.attribute(path, "role", std::string(to_text(access_role(lesson.scene.seats[i].role))));
    file.attribute(path, "kind", std::string(lesson.scene.seats[i].kind == SeatKind::kMaster ? "master" : "slave"));
  }
  for (const ToolSpec& tool : lesson.scene.tools) file.group("/tools/" + tool.name);
}

}  // namespace

std::string export_hdf5(LessonSource& lesson, const std::string& file, const ExportProgress& progress) {
  PendingPath pending(file);
  Hdf5File out(pending.path());
  const Lesson& head = lesson.head();
  write_metadata(out, head);
  write_groups(out, head);
  GapFinder gaps;
  if (std::string problem = write_rows(out, lesson, gaps, progress); !problem.empty()) return problem;
  write_gaps(out, gaps.gaps());
  write_links(out, head);
  write_notes(out, head);
  write_counts(out, head);
  if (std::string problem = out.close(); !problem.empty()) return problem;
  return pending.commit();
}

}  // namespace tandem::server
