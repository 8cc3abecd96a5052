#include "server/export/app/lerobot_export.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <optional>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/output_file.h"
#include "proto/recording/lesson_columns.h"
#include "server/export/app/parquet_process.h"
#include "server/export/lerobot_card.h"
#include "server/export/lesson_records.h"

namespace tandem::server {

namespace {

static_assert(std::endian::native == std::endian::little, "the numbers are sent as they lie in memory");

constexpr std::size_t kFramesAtOnce = 500;  // frames of a row group

/// Bytes of the columns of some rows, one column after the other.
class ColumnBytes {
 public:
  void add(LerobotType type, double value) {
    if (type == LerobotType::kFloat32) return put(static_cast<float>(value));
    if (type == LerobotType::kInt64) return put(static_cast<std::int64_t>(value));
    put(static_cast<std::uint8_t>(value != 0));
  }
  template <class Number>
  void put(Number number) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof number);
    std::memcpy(bytes_.data() + at, &number, sizeof number);
  }
  void put_all(const std::vector<double>& numbers) {
    for (const double number : numbers) put(number);
  }
  void clear() noexcept { bytes_.clear(); }
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

ParquetColumn column_of(const LerobotFeature& feature) {
  using Type = ParquetColumn::Type;
  const bool single = feature.shape == std::vector<std::size_t>{1} && feature.columns.empty();
  return {feature.name,
          feature.type == LerobotType::kFloat32 ? Type::kFloat
          : feature.type == LerobotType::kInt64 ? Type::kInt64
                                                : Type::kBoolean,
          single ? std::vector<std::size_t>{} : feature.shape};
}

/// Returns the first difference of two layouts; empty: none.
std::string layout_difference(const LerobotLayout& a, const LerobotLayout& b) {
  if (a.window() != b.window()) return "another rate of ticks";
  for (std::size_t k = 0; k < a.features().size(); ++k)
    if (a.features()[k] != b.features()[k]) return "other seats, tools or roles: feature " + a.features()[k].name;
  return {};
}

/// Rows of a lesson around the frames that are written.
class FrameRows {
 public:
  explicit FrameRows(LessonSource& source) : source_(&source) {
    rows_.scene = source.head().scene;
    rows_.seats.resize(source.head().seats.size());
    rows_.tools.resize(source.head().tools.size());
  }

  /// Reads on until there is a row at this tick or later, or no further row. @return the error of the source
  [[nodiscard]] std::string read_to(std::uint64_t tick) {
    while (!ended_ && (rows_.rows() == 0 || rows_.tick.back() < tick)) {
      const auto piece = source_->next();
      if (!piece) return piece.error();
      ended_ = *piece == nullptr;
      if (!ended_) rec::copy_rows(**piece, 0, (*piece)->rows(), rows_);
    }
    return {};
  }
  /// Forgets the rows before this tick, but the last of them, whose values a window without rows repeats.
  void forget_before(std::uint64_t tick) {
    const auto end = std::ranges::lower_bound(rows_.tick, tick) - rows_.tick.begin();
    if (end > 1) rec::erase_rows(rows_, static_cast<std::size_t>(end) - 1);
  }
  [[nodiscard]] const Lesson& rows() const noexcept { return rows_; }

 private:
  LessonSource* source_;
  Lesson rows_;
  bool ended_ = false;
};

/// Writes one data set into a folder.
class LerobotWriter {
 public:
  LerobotWriter(const LerobotRequest& request, const std::string& folder, const ExportProgress& progress)
      : request_(&request), folder_(folder), progress_(&progress) {}

  [[nodiscard]] std::string run();

 private:
  [[nodiscard]] std::string add_episode(LessonSource& lesson);
  [[nodiscard]] std::string begin_file(std::int64_t episode, std::int64_t bytes);
  [[nodiscard]] std::string write_meta();
  [[nodiscard]] std::string write_text(const std::string& name, const std::string& text) const;
  void write_tables();
  [[nodiscard]] std::string make_folder_of(const std::string& file) const;
  void write_episodes_table();
  [[nodiscard]] std::vector<LerobotStats> empty_stats() const;

  const LerobotRequest* request_;
  std::string folder_;
  const ExportProgress* progress_;
  ParquetProcess parquet_;
  std::optional<LerobotLayout> layout_;
  LerobotDataset set_;
  std::vector<LerobotStats> total_;
  std::int64_t file_ = -1, file_bytes_ = 0;  ///< data file that is open; -1: none
};

std::vector<LerobotStats> LerobotWriter::empty_stats() const {
  std::vector<LerobotStats> stats;
  for (const LerobotFeature& feature : layout_->features()) stats.emplace_back(feature.size());
  return stats;
}

std::string LerobotWriter::make_folder_of(const std::string& file) const {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(folder_ + "/" + file).parent_path(), error);
  return error ? folder_ + "/" + file + " cannot be written: " + io::write_error_text(error.value()) : std::string{};
}

/// Makes the data file of an episode the open one; v3.0 has several episodes in a file.
std::string LerobotWriter::begin_file(std::int64_t episode, std::int64_t bytes) {
  const bool next = file_ < 0 || set_.version == LerobotVersion::k21 || file_bytes_ + bytes > kLerobotFileMax;
  file_bytes_ = next ? bytes : file_bytes_ + bytes;
  if (!next) return {};
  if (file_ >= 0) parquet_.end();
  const std::string path = lerobot_data_path(set_.version, episode, ++file_);
  if (std::string problem = make_folder_of(path); !problem.empty()) return problem;
  std::vector<ParquetColumn> columns;
  for (const LerobotFeature& feature : layout_->features()) columns.push_back(column_of(feature));
  parquet_.begin(folder_ + "/" + path, columns);
  return parquet_.error();
}

std::string LerobotWriter::add_episode(LessonSource& lesson) {
  const auto episode = static_cast<std::int64_t>(set_.episodes.size());
  const LessonExtent extent = lesson.extent();
  const std::size_t frames = layout_->frames(extent);
  if (frames == 0)
    return format("it is shorter than one frame: %zu ticks at %u frames per second", layout_->window(), layout_->fps());
  LerobotEpisode made{static_cast<std::int64_t>(frames), set_.frames(), 0, empty_stats()};
  std::size_t numbers = 0;
  for (const LerobotFeature& feature : layout_->features()) numbers += feature.size();
  if (std::string problem = begin_file(episode, static_cast<std::int64_t>(frames * numbers * sizeof(float)));
      !problem.empty())
    return problem;
  made.file = file_;
  ColumnBytes bytes;
  std::vector<double> values;
  FrameRows rows(lesson);
  const auto tick_of = [&](std::size_t frame) { return extent.first_tick + std::uint64_t{frame} * layout_->window(); };
  for (std::size_t first = 0; first < frames; first += kFramesAtOnce) {
    const std::size_t count = std::min(kFramesAtOnce, frames - first);
    if (std::string problem = rows.read_to(tick_of(first + count)); !problem.empty()) return problem;
    rows.forget_before(tick_of(first));
    bytes.clear();
    for (std::size_t k = 0; k < layout_->features().size(); ++k) {
      const LerobotFeature& feature = layout_->features()[k];
      values.resize(feature.size());
      for (std::size_t frame = first; frame < first + count; ++frame) {
        const auto number = static_cast<std::int64_t>(frame);
        layout_->fill(rows.rows(), {episode, number, made.from + number, extent.first_tick}, k, values);
        made.stats[k].add(values);
        total_[k].add(values);
        for (const double value : values) bytes.add(feature.type, value);
      }
    }
    parquet_.rows(count, bytes.bytes());
    if (!parquet_.error().empty()) return parquet_.error();
    const double share = static_cast<double>(first + count) / static_cast<double>(frames);
    if (!(*progress_)((static_cast<double>(episode) + share) / static_cast<double>(request_->episodes)))
      return kExportInterrupted;
  }
  set_.episodes.push_back(std::move(made));
  return {};
}

/// `meta/tasks.parquet` and `meta/episodes` of v3.0.
void LerobotWriter::write_tables() {
  using Type = ParquetColumn::Type;
  ColumnBytes bytes;
  parquet_.begin(folder_ + "/meta/tasks.parquet",
                 {{"task_index", Type::kInt64, {}}, {"__index_level_0__", Type::kString, {}}},
                 {{"pandas", lerobot_tasks_pandas()}});
  bytes.put(std::int64_t{0});
  parquet_.rows(1, bytes.bytes(), {{"__index_level_0__", {set_.task}}});
  parquet_.end();
  write_episodes_table();
}

void LerobotWriter::write_episodes_table() {
  using Type = ParquetColumn::Type;
  std::vector<ParquetColumn> columns{{"episode_index", Type::kInt64, {}},
                                     {"tasks", Type::kString, {1}},
                                     {"length", Type::kInt64, {}},
                                     {"data/chunk_index", Type::kInt64, {}},
                                     {"data/file_index", Type::kInt64, {}},
                                     {"dataset_from_index", Type::kInt64, {}},
                                     {"dataset_to_index", Type::kInt64, {}},
                                     {"meta/episodes/chunk_index", Type::kInt64, {}},
                                     {"meta/episodes/file_index", Type::kInt64, {}}};
  for (const LerobotFeature& feature : layout_->features()) {
    for (const char* value : {"min", "max", "mean", "std"})
      columns.push_back({"stats/" + feature.name + "/" + value, Type::kDouble, feature.shape});
    columns.push_back({"stats/" + feature.name + "/count", Type::kInt64, {1}});
  }
  parquet_.begin(folder_ + "/meta/episodes/chunk-000/file-000.parquet", columns);
  ColumnBytes bytes;
  for (std::size_t e = 0; e < set_.episodes.size(); ++e) {
    const LerobotEpisode& episode = set_.episodes[e];
    bytes.clear();
    for (const std::int64_t number : {static_cast<std::int64_t>(e), episode.frames,
                                      episode.file / kLerobotFilesPerChunk, episode.file % kLerobotFilesPerChunk,
                                      episode.from, episode.from + episode.frames, std::int64_t{0}, std::int64_t{0}})
      bytes.put(number);
    for (const LerobotStats& stats : episode.stats) {
      for (const std::vector<double>& numbers : {stats.min(), stats.max(), stats.mean(), stats.deviation()})
        bytes.put_all(numbers);
      bytes.put(static_cast<std::int64_t>(stats.frames()));
    }
    parquet_.rows(1, bytes.bytes(), {{"tasks", {set_.task}}});
  }
  parquet_.end();
}

std::string LerobotWriter::write_text(const std::string& name, const std::string& text) const {
  if (std::string problem = make_folder_of(name); !problem.empty()) return problem;
  io::OutputFile out;
  if (std::string problem = out.open(folder_ + "/" + name, false); !problem.empty()) return problem;
  out.write(text);
  return out.close();
}

std::string LerobotWriter::write_meta() {
  std::string problem = write_text("README.md", lerobot_card(set_, *layout_));
  const auto also = [&](const char* name, const std::string& text) {
    if (problem.empty()) problem = write_text(name, text);
  };
  also("meta/info.json", lerobot_info_json(set_, *layout_));
  if (set_.version == LerobotVersion::k21) {
    also("meta/tasks.jsonl", lerobot_tasks_lines(set_));
    also("meta/episodes.jsonl", lerobot_episodes_lines(set_));
    also("meta/episodes_stats.jsonl", lerobot_episodes_stats_lines(set_, *layout_));
    return problem;
  }
  also("meta/stats.json", lerobot_stats_json(*layout_, total_));
  if (problem.empty()) problem = make_folder_of("meta/episodes/chunk-000/file-000.parquet");
  if (problem.empty()) write_tables();
  return problem.empty() ? parquet_.error() : problem;
}

std::string LerobotWriter::run() {
  if (!parquet_.error().empty()) return parquet_.error();
  set_.version = request_->version;
  for (std::size_t e = 0; e < request_->episodes; ++e) {
    const auto lesson = request_->lesson(e);
    if (!lesson) return lesson.error();
    const Lesson& head = (*lesson)->head();
    const std::string named = "episode " + std::to_string(e) + ", session " + sanitize(head.session, 60) + ": ";
    auto layout = LerobotLayout::make(head.scene, request_->fps);
    if (!layout) return named + layout.error();
    if (layout_) {
      if (const std::string other = layout_difference(*layout_, *layout); !other.empty())
        return named + "it has " + other + "; all episodes of a data set must be alike";
    } else {
      layout_ = std::move(*layout);
      total_ = empty_stats();
      set_.task = request_->task.empty() ? "scene " + head.scene.name : request_->task;
    }
    const std::string problem = add_episode(**lesson);
    if (!problem.empty()) return problem == kExportInterrupted ? problem : named + problem;
  }
  parquet_.end();
  const std::string problem = write_meta();
  return problem.empty() ? parquet_.finish() : problem;
}

}  // namespace

std::string export_lerobot(const LerobotRequest& request, const std::string& folder, const ExportProgress& progress) {
  PendingPath pending(folder);
  std::error_code error;
  if (!std::filesystem::create_directory(pending.path(), error) && error)
    return pending.path() + " cannot be made: " + io::write_error_text(error.value());
  if (std::string problem = LerobotWriter(request, pending.path(), progress).run(); !problem.empty()) return problem;
  return pending.commit();
}

}  // namespace tandem::server
