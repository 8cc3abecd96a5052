#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/export/lerobot_layout.h"

/// The metadata of a data set of LeRobot as text: `info.json`, statistics, episodes, tasks.
namespace tandem::server {

/// Versions of the format.
enum class LerobotVersion : std::uint8_t { k21, k30 };
/// Returns v2.1 or v3.0.
[[nodiscard]] const char* to_text(LerobotVersion version) noexcept;

/// Smallest, largest, mean and standard deviation of each number of a feature. Numbers that are not finite are left
/// out; without a finite number all four are 0.
class LerobotStats {
 public:
  explicit LerobotStats(std::size_t size) : columns_(size) {}
  /// Adds the numbers of one frame.
  void add(std::span<const double> values) noexcept;
  /// Number of frames.
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  [[nodiscard]] std::vector<double> min() const;
  [[nodiscard]] std::vector<double> max() const;
  [[nodiscard]] std::vector<double> mean() const;
  [[nodiscard]] std::vector<double> deviation() const;  ///< of the population

 private:
  struct Column {
    double min = 0, max = 0, mean = 0, squares = 0;  ///< squares: sum of squared distances to the mean
    std::uint64_t count = 0;
  };
  template <class Value>
  [[nodiscard]] std::vector<double> each(Value value) const {
    std::vector<double> out;
    for (const Column& column : columns_) out.push_back(value(column));
    return out;
  }

  std::vector<Column> columns_;
  std::uint64_t frames_ = 0;
};

/// One episode of a data set.
struct LerobotEpisode {
  std::int64_t frames = 0;
  std::int64_t from = 0;            ///< number of its first frame in the data set
  std::int64_t file = 0;            ///< v3.0: number of the data file
  std::vector<LerobotStats> stats;  ///< of each feature
};

/// A data set.
struct LerobotDataset {
  LerobotVersion version = LerobotVersion::k30;
  std::string task;  ///< subject of the lessons, in words
  std::vector<LerobotEpisode> episodes;

  [[nodiscard]] std::int64_t frames() const noexcept {
    return episodes.empty() ? 0 : episodes.back().from + episodes.back().frames;
  }
};

inline constexpr std::int64_t kLerobotFilesPerChunk = 1000;
/// Size of the numbers above which an episode begins the next data file, v3.0.
inline constexpr std::int64_t kLerobotFileMax = 100 << 20;

/// Returns the path of the data file with an episode, below the folder of the data set.
[[nodiscard]] std::string lerobot_data_path(LerobotVersion version, std::int64_t episode, std::int64_t file);
[[nodiscard]] std::string lerobot_info_json(const LerobotDataset& set, const LerobotLayout& layout);
/// Returns `meta/stats.json`, v3.0. @param total  of each feature over all episodes
[[nodiscard]] std::string lerobot_stats_json(const LerobotLayout& layout, const std::vector<LerobotStats>& total);
// One JSON object per line, v2.1.
[[nodiscard]] std::string lerobot_tasks_lines(const LerobotDataset& set);
[[nodiscard]] std::string lerobot_episodes_lines(const LerobotDataset& set);
[[nodiscard]] std::string lerobot_episodes_stats_lines(const LerobotDataset& set, const LerobotLayout& layout);
/// Returns the metadata of `meta/tasks.parquet` by which pandas restores the task as index of the table, v3.0.
[[nodiscard]] std::string lerobot_tasks_pandas();

}  // namespace tandem::server
