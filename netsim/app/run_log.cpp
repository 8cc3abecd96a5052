#include "netsim/app/run_log.h"

#include "common/io/whole_file.h"
#include "netsim/profiles/app/network_options.h"
#include "netsim/profiles/decision_csv.h"

namespace tandem::netsim {
namespace {

/// Capacity for a second of traffic: 64 datagrams and copies per millisecond.
constexpr std::size_t kRoom = 64'000;
constexpr Duration kEvery = std::chrono::seconds(1);
constexpr std::uintmax_t kFileMax = std::uintmax_t{1} << 30;

}  // namespace

std::string RunLog::open(const std::string& name) {
  std::string problem = file_.open(name, false);
  if (file_.is_open()) file_.write(decision_csv_header());
  return problem;
}

void RunLog::attach(Network& network) {
  if (!file_.is_open()) return;
  log_.reserve(kRoom);
  network_ = &network;
  network.log_to(&log_);
}

void RunLog::on_tick(Time now) {
  if (network_ == nullptr || (now < next_ && log_.free_rows() > kRoom / 2)) return;
  next_ = now + kEvery;
  write(network_->oldest_in_flight().value_or(now));
  log_.reserve(kRoom);
}

void RunLog::write(Time until) {
  std::string text;
  for (const Decision& row : log_.take_before(until)) append_csv(row, text);
  file_.write(text);
}

std::string RunLog::close() {
  if (network_ != nullptr) {
    log_.reserve(kRoom);
    network_->log_in_flight();
    write(Time::max());
    network_->log_to(nullptr);
    if (log_.missed() > 0) return std::to_string(log_.missed()) + " decisions did not fit into the log";
  }
  return file_.close();
}

std::expected<std::shared_ptr<const Replay>, std::string> load_replay(const std::string& file) {
  const auto text = io::read_whole_file(file, kFileMax);
  if (!text) return std::unexpected(text.error());
  const auto rows = parse_decision_csv(*text, file);
  if (!rows) return std::unexpected(lines_of(rows.error()));
  auto replay = Replay::make(*rows);
  if (!replay) return std::unexpected(file + ": " + replay.error());
  return std::make_shared<const Replay>(std::move(*replay));
}

}  // namespace tandem::netsim
