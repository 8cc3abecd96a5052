#include "server/export/lerobot_meta.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/base/format.h"

namespace tandem::server {

namespace {

using MetaJson = nlohmann::ordered_json;

std::string line(const MetaJson& json) { return json.dump(-1, ' ', false, MetaJson::error_handler_t::replace) + "\n"; }

/// Gives flat numbers the shape of the feature.
MetaJson shaped(const std::vector<double>& flat, const std::vector<std::size_t>& shape) {
  if (shape.size() < 2) return flat;
  MetaJson rows = MetaJson::array();
  const std::size_t width = shape.back();
  for (std::size_t at = 0; at + width <= flat.size(); at += width)
    rows.push_back(std::vector<double>(flat.begin() + static_cast<std::ptrdiff_t>(at),
                                       flat.begin() + static_cast<std::ptrdiff_t>(at + width)));
  return rows;
}

MetaJson stats_json(const LerobotLayout& layout, const std::vector<LerobotStats>& stats) {
  MetaJson out = MetaJson::object();
  for (std::size_t k = 0; k < stats.size(); ++k) {
    const LerobotFeature& feature = layout.features()[k];
    out[feature.name] = {{"min", shaped(stats[k].min(), feature.shape)},
                         {"max", shaped(stats[k].max(), feature.shape)},
                         {"mean", shaped(stats[k].mean(), feature.shape)},
                         {"std", shaped(stats[k].deviation(), feature.shape)},
                         {"count", MetaJson::array({stats[k].frames()})}};
  }
  return out;
}

MetaJson feature_json(const LerobotFeature& feature, const LerobotLayout& layout, LerobotVersion version) {
  MetaJson out = {{"dtype", to_text(feature.type)}, {"shape", feature.shape}, {"names", nullptr}};
  if (feature.shape.size() == 2) {
    out["names"] = {"tick", "signal"};
    out["info"] = {{"signals", feature.columns}, {"ticks_per_second", layout.fps() * layout.window()}};
  } else if (!feature.columns.empty()) {
    out["names"] = feature.columns;
  }
  if (version == LerobotVersion::k30) out["fps"] = layout.fps();
  return out;
}

}  // namespace

const char* to_text(LerobotVersion version) noexcept { return version == LerobotVersion::k21 ? "v2.1" : "v3.0"; }

void LerobotStats::add(std::span<const double> values) noexcept {
  ++frames_;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const double value = values[k];
    if (!std::isfinite(value)) continue;
    Column& c = columns_[k];
    if (++c.count == 1) c.min = c.max = value;
    c.min = std::min(c.min, value);
    c.max = std::max(c.max, value);
    const double before = value - c.mean;  // Welford 1962
    c.mean += before / static_cast<double>(c.count);
    c.squares += before * (value - c.mean);
  }
}

std::vector<double> LerobotStats::min() const {
  return each([](const Column& c) { return c.min; });
}
std::vector<double> LerobotStats::max() const {
  return each([](const Column& c) { return c.max; });
}
std::vector<double> LerobotStats::mean() const {
  return each([](const Column& c) { return c.mean; });
}
std::vector<double> LerobotStats::deviation() const {
  return each([](const Column& c) { return c.count == 0 ? 0 : std::sqrt(c.squares / static_cast<double>(c.count)); });
}

std::string lerobot_data_path(LerobotVersion version, std::int64_t episode, std::int64_t file) {
  const auto number = [](std::int64_t value) { return static_cast<long long>(value); };
  if (version == LerobotVersion::k21)
    return format("data/chunk-%03lld/episode_%06lld.parquet", number(episode / kLerobotFilesPerChunk), number(episode));
  return format("data/chunk-%03lld/file-%03lld.parquet", number(file / kLerobotFilesPerChunk),
                number(file % kLerobotFilesPerChunk));
}

std::string lerobot_info_json(const LerobotDataset& set, const LerobotLayout& layout) {
  const auto episodes = static_cast<std::int64_t>(set.episodes.size());
  const bool old = set.version == LerobotVersion::k21;
  MetaJson out = {{"codebase_version", to_text(set.version)},
                  {"robot_type", "tandem"},
                  {"total_episodes", episodes},
                  {"total_frames", set.frames()},
                  {"total_tasks", 1}};
  if (old) {
    out["total_videos"] = 0;
    out["total_chunks"] = (episodes + kLerobotFilesPerChunk - 1) / kLerobotFilesPerChunk;
  }
  out["chunks_size"] = kLerobotFilesPerChunk;
  if (!old) {
    out["data_files_size_in_mb"] = kLerobotFileMax >> 20;
    out["video_files_size_in_mb"] = 500;
  }
  out["fps"] = layout.fps();
  out["splits"] = {{"train", "0:" + std::to_string(episodes)}};
  out["data_path"] = old ? "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet"
                         : "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet";
  out["video_path"] = nullptr;
  for (const LerobotFeature& feature : layout.features())
    out["features"][feature.name] = feature_json(feature, layout, set.version);
  return out.dump(4, ' ', false, MetaJson::error_handler_t::replace) + "\n";
}

std::string lerobot_stats_json(const LerobotLayout& layout, const std::vector<LerobotStats>& total) {
  return stats_json(layout, total).dump(4) + "\n";
}

std::string lerobot_tasks_lines(const LerobotDataset& set) { return line({{"task_index", 0}, {"task", set.task}}); }

std::string lerobot_episodes_lines(const LerobotDataset& set) {
  std::string lines;
  for (std::size_t e = 0; e < set.episodes.size(); ++e)
    lines += line({{"episode_index", e}, {"tasks", MetaJson::array({set.task})}, {"length", set.episodes[e].frames}});
  return lines;
}

std::string lerobot_episodes_stats_lines(const LerobotDataset& set, const LerobotLayout& layout) {
  std::string lines;
  for (std::size_t e = 0; e < set.episodes.size(); ++e)
    lines += line({{"episode_index", e}, {"stats", stats_json(layout, set.episodes[e].stats)}});
  return lines;
}

std::string lerobot_tasks_pandas() {
  constexpr const char* kIndex = "__index_level_0__";
  const auto column = [](const MetaJson& name, const char* field, const char* type, const char* numpy) {
    return MetaJson{
        {"name", name}, {"field_name", field}, {"pandas_type", type}, {"numpy_type", numpy}, {"metadata", nullptr}};
  };
  MetaJson labels = column(nullptr, "None", "unicode", "object");
  labels["metadata"] = {{"encoding", "UTF-8"}};
  const MetaJson out = {{"index_columns", MetaJson::array({kIndex})},
                        {"column_indexes", MetaJson::array({labels})},
                        {"columns", MetaJson::array({column("task_index", "task_index", "int64", "int64"),
                                                     column(nullptr, kIndex, "unicode", "object")})},
                        {"attributes", MetaJson::object()},
                        {"creator", {{"library", "pyarrow"}, {"version", "14.0.0"}}},
                        {"pandas_version", "2.0.0"}};
  return out.dump();
}

}  // namespace tandem::server
