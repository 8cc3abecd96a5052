#include "netsim/profiles/network_csv.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "common/base/csv.h"
#include "netsim/profiles/table_errors.h"

namespace tandem::netsim {
namespace {

constexpr double kDelayMaxMs = 60'000;
constexpr double kTimeMaxS = 1e7;

class NetworkCsvReader {
 public:
  NetworkCsvReader(const CsvTable& table, std::string_view file, Duration interval)
      : table_(table),
        interval_(interval),
        rtt_(table.find("rtt_ms")),
        delay_(table.find("delay_ms")),
        time_(table.find("t_s")),
        lost_(table.find("lost")),
        errors_(file) {
    if (!time_) time_ = table.find("t_send_s");
  }

  std::expected<RecordedNetwork, InputErrors> read() {
    columns();
    if (errors_.empty()) rows();
    if (!errors_.empty()) return errors_.take();
    return finish();
  }

 private:
  void columns() {
    if (rtt_ && delay_) errors_.add("rtt_ms and delay_ms exclude each other");
    if (!rtt_ && !delay_) errors_.add("needs a column rtt_ms[ms] or delay_ms[ms]");
    if (!time_ && interval_ <= Duration::zero()) {
      errors_.add(
          "has no column t_s[s] or t_send_s[s]: give the time between rows, --trace-interval MS (in a scenario "
          "trace_interval_ms)");
    }
    for (const auto& column : {rtt_, delay_}) unit(column, "ms");
    unit(time_, "s");
    unit(lost_, "1");
    if (table_.rows() == 0) errors_.add("holds no row");
  }

  /// Checks the unit of a column. The column's name determines how its numbers are read, so a wrong unit would silently
  /// scale them. Words after the unit are free: `s since first row`.
  void unit(const std::optional<std::size_t>& column, std::string_view must) {
    if (!column) return;
    const CsvColumn& head = table_.columns()[*column];
    if (head.unit == must || head.unit.starts_with(std::string(must) + " ") ||
        head.unit.starts_with(std::string(must) + ";"))
      return;
    errors_.add(1, *column + 1, head.name, "[" + head.unit + "]",
                "its unit must be [" + std::string(must) + "]; convert the column");
  }

  void rows() {
    const std::size_t value = rtt_ ? *rtt_ : *delay_;
    double start_s = 0;
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      DelayTrace::Step step;
      const auto ms = table_.optional_number(row, value);
      if (!ms || (*ms && !(**ms >= 0 && **ms <= kDelayMaxMs))) {
        errors_.add(table_, row, value, "must be a number in [0, 60000] ms, or empty for lost");
      } else if (*ms) {
        step.delay = Duration{std::llround(**ms * (rtt_ ? 0.5e6 : 1e6))};
      } else {
        step.lost = true;
      }
      if (lost_) {
        const std::string_view lost = table_.cell(row, *lost_);
        if (lost == "1") step.lost = true;
        if (lost != "1" && lost != "0" && !lost.empty()) errors_.add(table_, row, *lost_, "must be 0 or 1");
      }
      step.at = interval_ * static_cast<std::int64_t>(row);
      if (time_) {
        const auto s = table_.number(row, *time_);
        if (!s || std::abs(*s) > kTimeMaxS) {
          errors_.add(table_, row, *time_, "must be a number of seconds");
          continue;
        }
        if (row == 0) start_s = *s;
        step.at = from_seconds(*s - start_s);
        if (!steps_.empty() && step.at <= steps_.back().at) errors_.add(table_, row, *time_, "time does not go on");
      }
      steps_.push_back(step);
    }
  }

  void find_gaps(RecordedNetwork& network) const {
    std::vector<Duration> distances;
    for (std::size_t i = 1; i < steps_.size(); ++i) distances.push_back(steps_[i].at - steps_[i - 1].at);
    if (distances.empty()) return;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    const Duration usual = std::max(20 * *middle, Duration{1'000'000'000});
    for (std::size_t i = 1; i < steps_.size(); ++i) {
      const Duration distance = steps_[i].at - steps_[i - 1].at;
      if (distance <= usual) continue;
      ++network.gaps;
      if (distance <= network.gap_longest) continue;
      network.gap_longest = distance;
      network.gap_line = table_.line(i - 1);
    }
  }

  RecordedNetwork finish() {
    // The last row is in force for the mean row distance; a single row lasts forever, because the recording repeats.
    const Duration last = steps_.back().at;
    const auto gaps = static_cast<std::int64_t>(steps_.size()) - 1;
    auto trace = std::make_shared<DelayTrace>();
    trace->period = last + (gaps > 0 ? std::max(last / gaps, Duration{1}) : Duration{1'000'000'000});
    RecordedNetwork network{.link = {},
                            .rtt_split = rtt_.has_value(),
                            .rows = steps_.size(),
                            .lost = static_cast<std::size_t>(std::ranges::count_if(steps_, &DelayTrace::Step::lost)),
                            .length = trace->period,
                            .timed = time_.has_value()};
    find_gaps(network);
    trace->steps = std::move(steps_);
    network.link.up.trace = trace;
    network.link.down.trace = std::move(trace);
    return network;
  }

  const CsvTable& table_;
  Duration interval_;
  std::optional<std::size_t> rtt_, delay_, time_, lost_;
  std::vector<DelayTrace::Step> steps_;
  TableErrors errors_;
};

}  // namespace

std::vector<std::string> notes_of(const RecordedNetwork& network, std::string_view file_name) {
  std::vector<std::string> notes;
  if (network.rtt_split)
    notes.push_back(std::string(file_name) + ": the recording holds round trips; each direction gets half of them");
  if (network.gaps > 0) {
    std::ostringstream note;
    note << file_name << ":" << network.gap_line << ": the recording has " << network.gaps
         << (network.gaps == 1 ? " gap" : " gaps") << ", the longest of " << seconds(network.gap_longest)
         << " s after this line; through a gap the last delay stays in force";
    notes.push_back(note.str());
  }
  return notes;
}

std::expected<RecordedNetwork, InputErrors> parse_network_csv(std::string_view text, std::string_view file_name,
                                                              Duration interval) {
  const auto table = CsvTable::parse(text);
  if (!table) {
    TableErrors errors{file_name};
    errors.add(table.error());
    return errors.take();
  }
  return NetworkCsvReader(*table, file_name, interval).read();
}

}  // namespace tandem::netsim
