#include "server/report/report_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/format.h"

namespace tandem::server {
namespace {

/// A value in millimetres or newtons, or a dash if there is none.
std::string cell(double value, double factor, int decimals) {
  return std::isfinite(value) ? format("%.*f", decimals, value * factor) : "-";
}

constexpr std::size_t kLabelsMin =
    28;  // width of phase and seat columns; with 50 for the numbers a table fits 80 columns
constexpr const char* kNumbers = " %8s %8s %6s %9s %6s %6s\n";

/// Display text of a gate state, the same as on the screens of seats.
std::string gate_words(const std::string& state) {
  for (const auto& [token, words] : {std::pair{"off", "no force"},
                                     {"zero", "force off"},
                                     {"ramp-in", "force rising"},
                                     {"active", "force on"},
                                     {"passive", "force fading"},
                                     {"DAMPED", "latched off"},
                                     {"FAULT", "device fault"}})
    if (state == token) return words;
  return state.empty() ? "-" : state;
}

/// The label columns before the numbers.
struct Labels {
  std::size_t phase = 5, seat = 4;  ///< widths of the widest entries
  void hold(const std::string& p, const std::string& s) {
    phase = std::max(phase, p.size());
    seat = std::max(seat, s.size());
  }
  /// Labels too wide for the table are put on a separate line above the numbers.
  [[nodiscard]] std::string text(const std::string& p, const std::string& s) const {
    const bool fits = phase + 2 + seat <= kLabelsMin;
    std::string out = fits        ? "  " + p + std::string(phase + 2 - p.size(), ' ') + s
                      : p.empty() ? ""
                                  : "  " + p + ", " + s + "\n";
    out.resize(std::max(out.size(), (fits ? 2 : out.size()) + (fits ? phase + 2 + seat : 2)), ' ');
    return out;
  }
};

/// @param reached  false: the phase began after the end of the run, so its peaks do not exist
void put_row(std::string& out, const Labels& labels, const std::string& what, const std::string& seat,
             const SeatMetrics& m, bool reached) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  out += labels.text(what, seat);
  out += format(kNumbers, cell(m.tracking_rms_m, 1e3, 2).c_str(), cell(m.tracking_rms_lag_removed_m, 1e3, 2).c_str(),
                cell(m.transport_lag_rms_m, 1e3, 2).c_str(), cell(m.force_error_rms_n, 1, 3).c_str(),
                cell(reached ? m.effort_peak_n : nothing, 1, 2).c_str(),
                cell(reached ? m.speed_peak_m_s : nothing, 1, 3).c_str());
}

}  // namespace

std::string report_summary(const RunReport& r, const SceneSpec& scene) {
  std::string out;
  Labels labels;
  for (const auto& s : r.seats) {
    if (s.kind != SeatKind::kMaster || !s.taken) continue;
    labels.hold(r.phases.empty() ? "whole session" : "all phases", s.name);
    for (const auto& p : r.phases) labels.hold(p.name, s.name);
    if (r.outside) labels.hold(r.outside->name, s.name);
  }
  const std::string phase_head = labels.text("phase", "seat"), no_head = labels.text("", "");
  out += phase_head;
  out += format(kNumbers, "tracking", "lag free", "lag", "force err", "peak", "speed");
  out += no_head;
  out += format(kNumbers, "RMS [mm]", "[mm]", "[mm]", "RMS [N]", "[N]", "[m/s]");
  for (const auto& s : r.seats)
    if (s.kind == SeatKind::kMaster && s.taken)
      put_row(out, labels, r.phases.empty() ? "whole session" : "all phases", s.name, s.metrics, r.duration_s > 0);
  const auto put_part = [&](const PhaseReport& p) {
    for (std::size_t i = 0; i < p.seats.size(); ++i)
      if (r.seats[i].kind == SeatKind::kMaster && r.seats[i].taken)
        put_row(out, labels, p.name, r.seats[i].name, p.seats[i], p.from_s < r.duration_s);
  };
  for (const auto& p : r.phases) put_part(p);
  if (r.outside) put_part(*r.outside);
  out +=
      "  tracking: distance from hand to tool; lag free: the same without a constant lag; lag: by the delay alone; "
      "peak "
      "and speed: the largest of the hand\n";
  std::string free;
  for (const auto& s : r.seats) {
    if (!s.taken) {
      free += (free.empty() ? "" : ", ") + s.name;
      continue;
    }
    out += format(
        "  %s: round trip %.1f ms (p99 %.1f), loss up %.1f %% down %.1f %%, longest gap %.0f / %.0f ms, gate trips "
        "%u, at the end %s\n",
        s.name.c_str(), s.link.rtt_p50_ms, s.link.rtt_p99_ms, s.link.up.loss_percent, s.link.down.loss_percent,
        s.link.up.longest_gap_ms, s.link.down.longest_gap_ms, s.gate_trips, gate_words(s.gate).c_str());
  }
  if (!free.empty()) out += "  not taken: " + free + "\n";
  for (std::size_t j = 0; j < r.tools.size(); ++j)
    if (r.tools[j].contact_force_rms_n > 0)
      out += format("  %s: contact force RMS %.2f N, penetration at most %.3f mm\n", scene.tools[j].name.c_str(),
                    r.tools[j].contact_force_rms_n, r.tools[j].penetration_max_m * 1e3);
  for (std::size_t j = 0; j < r.tools.size(); ++j)
    if (r.tools[j].held_s > 0.01)
      out += format(
          "  %s: braked (HELD) for %.1f s: no seat with authority over it, or not its own slave, was connected; no "
          "hand was guided\n",
          scene.tools[j].name.c_str(), r.tools[j].held_s);
  if (r.unleased_s > 0)
    out += format(
        "  HELD for %.1f s: the directory of the service (etcd) did not answer in time, so another server might have "
        "owned the session; no hand was engaged\n",
        r.unleased_s);
  if (r.stopped_s > 0)
    out += format("  the session was stopped for %.1f s, in which its clock did not advance\n", r.stopped_s);
  if (r.duration_s <= 0) {
    out += "  not judged: the session never ran\n";
  } else if (r.judged_s <= 0) {
    out += "  not judged: no seat was engaged for more than a second, undisturbed, so no errors could be measured\n";
  } else if (!r.moved) {
    out += format("  not judged: no hand moved by more than %.0f mm; the figures above do not measure tracking\n",
                  ReportBuilder::kMoved * 1e3);
  } else {
    out += format(
        "  judged: %.1f of %.1f s; not in it are times without an engaged hand, the first second after each "
        "engagement, and scripted pushes\n",
        r.judged_s, r.duration_s);
  }
  if (r.sparse_s > 0)
    out += format(
        "  sampled every %.0f ms for %.1f of %.1f s: peaks between the samples are not in the table, and speed is the "
        "mean between two of them; %s\n",
        1e3 * r.sparse_gap_s, r.sparse_s, r.duration_s,
        r.shed_rows > 0
            ? "the server was too busy and left rows out (load shedding): give it fewer sessions or programs"
            : "`--json`, `--trace` or `reports` sample every tick");
  for (const auto& v : r.violations)
    out += format("  %s invariant %s%s%s first at %.3f s, %llu times%s\n",
                  v.expected ? "broken, never promised:" : "BROKEN:", v.invariant.c_str(), v.seat.empty() ? "" : " at ",
                  v.seat.c_str(), v.at_s, static_cast<unsigned long long>(v.count),
                  v.expected ? "" : " - the verdict fails");
  return out;
}

}  // namespace tandem::server
