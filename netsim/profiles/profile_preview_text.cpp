#include "netsim/profiles/profile_preview_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/base/format.h"
#include "netsim/plot/ticks.h"
#include "netsim/quality/quality_text.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kWidthMin = 40, kWidthMax = 300, kRows = 12, kLabel = 10;
constexpr double kLogFrom = 6;  ///< ratio of the ends above which the scale is logarithmic

/// Rows of delay, in ascending order.
class Scale {
 public:
  /// @param lo, hi  smallest and largest delay [s]
  Scale(double lo, double hi) {
    log_ = lo > 0 && hi > kLogFrom * lo;
    if (!log_ && hi - lo < 1e-6) {  // constant delay: widen the range around it
      lo -= std::min(lo, 0.5e-3);
      hi += 0.5e-3;
    }
    lo_ = log_ ? std::log(lo) : lo;
    hi_ = log_ ? std::log(hi) : hi;
  }
  [[nodiscard]] std::size_t row_of(double s) const noexcept {
    const double at = ((log_ ? std::log(std::max(s, 1e-9)) : s) - lo_) / (hi_ - lo_) * kRows;
    return static_cast<std::size_t>(std::clamp(at, 0.0, kRows - 1.0));
  }
  /// Returns the smallest delay of a row; for kRows, the largest delay of all.
  [[nodiscard]] double begin_of(std::size_t row) const noexcept {
    const double at = lo_ + (hi_ - lo_) * static_cast<double>(row) / kRows;
    return log_ ? std::exp(at) : std::max(at, 0.0);
  }

 private:
  bool log_ = false;
  double lo_ = 0, hi_ = 1;
};

/// Returns the shade of a share: none, below 1 %, below 10 %, below 50 %, above.
const char* shade(double share, bool utf8) noexcept {
  static constexpr std::array kBlocks{" ", "░", "▒", "▓", "█"};
  static constexpr std::array kLetters{" ", ".", ":", "+", "#"};
  const std::size_t level = share <= 0 ? 0 : share < 0.01 ? 1 : share < 0.1 ? 2 : share < 0.5 ? 3 : 4;
  return (utf8 ? kBlocks : kLetters)[level];
}

std::string right(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

/// Returns the line without spaces at its end, and a line feed.
std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string axis(double length_s, std::size_t columns, bool utf8) {
  std::string line, numbers(columns + 8, ' ');
  const plot::Ticks ticks = plot::round_ticks(0, length_s, std::max(2, static_cast<int>(columns / 12)));
  std::vector<bool> marked(columns);
  for (const double t : ticks.values) {
    const auto at = static_cast<std::size_t>(std::llround(t / length_s * static_cast<double>(columns - 1)));
    marked[std::min(at, columns - 1)] = true;
    const std::string text = format("%.*f s", ticks.decimals, std::abs(t));
    numbers.replace(at, text.size(), text);
  }
  for (std::size_t c = 0; c < columns; ++c) line += utf8 ? (marked[c] ? "┴" : "─") : (marked[c] ? "+" : "-");
  return std::string(kLabel, ' ') + (utf8 ? "└" : "+") + line + "\n" + trimmed(std::string(kLabel + 1, ' ') + numbers);
}

}  // namespace

std::string delay_picture(const ProfilePreviewDirection& way, Duration shown, const PictureStyle& style) {
  const std::size_t width = std::clamp(style.width, kWidthMin, kWidthMax);
  const std::size_t columns = std::min(width - kLabel - 2, way.shown.size());
  if (columns == 0) return "";
  std::int32_t lo = INT32_MAX, hi = -1;
  for (const std::int32_t us : way.shown) {
    if (us == ProfilePreviewDirection::kLost) continue;
    lo = std::min(lo, us);
    hi = std::max(hi, us);
  }
  const Scale scale{hi < 0 ? 0 : lo * 1e-6, hi < 0 ? 1e-3 : hi * 1e-6};
  std::vector<std::array<std::uint32_t, kRows>> cells(columns);
  std::vector<std::uint32_t> sent(columns), lost(columns);
  for (std::size_t i = 0; i < way.shown.size(); ++i) {
    const std::size_t column = i * columns / way.shown.size();
    ++sent[column];
    if (way.shown[i] == ProfilePreviewDirection::kLost) {
      ++lost[column];
    } else {
      ++cells[column][scale.row_of(way.shown[i] * 1e-6)];
    }
  }
  const auto share = [&](std::uint32_t n, std::size_t column) { return n / static_cast<double>(sent[column]); };
  std::string text;
  for (std::size_t row = kRows; row-- > 0;) {
    std::string line = right(
        row % 2 == 0 || row + 1 == kRows ? delay_text(scale.begin_of(row + 1 == kRows ? kRows : row)) : "", kLabel - 1);
    line += style.utf8 ? " │" : " |";
    for (std::size_t c = 0; c < columns; ++c) line += shade(share(cells[c][row], c), style.utf8);
    text += trimmed(std::move(line));
  }
  text += axis(seconds(shown), columns, style.utf8);
  std::string line = right("lost", kLabel - 1) + "  ";
  for (std::size_t c = 0; c < columns; ++c) line += shade(share(lost[c], c), style.utf8);
  const auto legend = [&](double s) { return std::string(shade(s, style.utf8)); };
  return text + trimmed(std::move(line)) + std::string(kLabel + 1, ' ') +
         "each mark: a share of what was sent then: " + legend(0.001) + " below 1 %  " + legend(0.05) +
         " below 10 %  " + legend(0.2) + " below half  " + legend(1) + " more\n";
}

std::string delay_histogram(const ProfilePreviewDirection& way, const PictureStyle& style) {
  if (way.delays.empty()) return std::string(kLabel + 1, ' ') + "nothing arrived\n";
  if (way.delays.back() - way.delays.front() < std::chrono::microseconds(1)) {
    return std::string(kLabel + 1, ' ') + "always " + delay_text(seconds(way.delays.front())) + "\n";
  }
  const std::size_t width = std::clamp(style.width, kWidthMin, kWidthMax);
  const Scale scale{seconds(way.delays.front()), seconds(way.delays.back())};
  std::array<std::uint64_t, kRows> counts{};
  for (const Duration d : way.delays) ++counts[scale.row_of(seconds(d))];
  const double all = static_cast<double>(way.delays.size());
  const double most = static_cast<double>(*std::ranges::max_element(counts)) / all;
  const double room = static_cast<double>(width - kLabel - 28);
  std::string text;
  std::uint64_t below = 0;
  for (std::size_t row = 0; row < kRows; ++row) {
    below += counts[row];
    const double share = static_cast<double>(counts[row]) / all;
    const auto halves = static_cast<std::size_t>(std::lround(2 * room * share / most));
    std::string bar;
    for (std::size_t i = 0; i < halves / 2; ++i) bar += style.utf8 ? "█" : "#";
    if (halves % 2 == 1 || (halves == 0 && counts[row] > 0)) bar += style.utf8 ? "▌" : ".";
    std::string line = right("to " + delay_text(scale.begin_of(row + 1)), kLabel + 4) + right(share_text(share), 10) +
                       right(share_text(static_cast<double>(below) / all), 10) + "  " + bar;
    text += trimmed(std::move(line));
  }
  return text;
}

}  // namespace tandem::netsim
