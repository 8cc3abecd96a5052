#include "netsim/score/metrics.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"

namespace tandem::netsim::score {
namespace {

using enum Metric;
using enum Better;
constexpr auto kMotionGroup = MetricGroup::kMotion;
constexpr auto kForceGroup = MetricGroup::kForce;
constexpr auto kContactGroup = MetricGroup::kContact;
constexpr auto kTrackGroup = MetricGroup::kTracking;
constexpr auto kShareGroup = MetricGroup::kSharing;
constexpr auto kPassiveGroup = MetricGroup::kPassivity;
constexpr auto kLinkGroup = MetricGroup::kLink;

// Formulas and their sources: netsim/README.md, "Scores".
constexpr std::array<MetricRow, kMetricCount> kRows{{
    {kTime, kMotionGroup, "time", "Time", "s", "s", 1, kLow, "Time of this part in which the session ran."},
    {kIdleTime, kMotionGroup, "idle_time", "Idle time", "s", "s", 1, kLow,
     "Time in which the hand is slower than the idle limit."},
    {kPathLength, kMotionGroup, "path_length", "Path length", "m", "mm", 1e3, kLow,
     "Length of the way of the hand's tip."},
    {kStraightShare, kMotionGroup, "straight_share", "Economy (straight distance / path)", "1", "%", 100, kHigh,
     "Straight distance from begin to end of each piece, over the path length. Not the economy of dVSS, which is the "
     "path length."},
    {kSpeedMean, kMotionGroup, "speed_mean", "Mean speed", "m/s", "mm/s", 1e3, kNeither, "Mean speed of the tip."},
    {kSpeedPeak, kMotionGroup, "speed_peak", "Peak speed", "m/s", "mm/s", 1e3, kNeither, "Largest speed of the tip."},
    {kSpeedPeaks, kMotionGroup, "speed_peaks", "Speed peaks", "1", "", 1, kLow,
     "Number of local maxima of the speed above the idle limit."},
    {kWorkspace, kMotionGroup, "workspace", "Workspace", "m^3", "cm³", 1e6, kLow,
     "Product of the ranges of the tip along the three axes."},
    {kHullVolume, kMotionGroup, "hull_volume", "Volume of the convex hull", "m^3", "cm³", 1e6, kLow,
     "Volume of the convex hull of the way of the tip, sampled at most at 50 Hz; 0 for a plane motion."},
    {kAngularPath, kMotionGroup, "angular_path", "Angular path", "rad", "rad", 1, kLow,
     "Sum of the angles by which the hand turns, from the filtered orientation."},
    {kSquaredJerk, kMotionGroup, "mean_squared_jerk", "Mean squared jerk", "m^2/s^6", "m²/s⁶", 1, kNeither,
     "Mean square of the third derivative of the position. It does not discriminate skill."},
    {kNormalisedJerk, kMotionGroup, "normalised_jerk", "Normalised jerk", "1", "", 1, kLow,
     "Duration^5 / path^2 times the integral of the squared jerk, mean of the pieces."},
    {kDimensionlessJerk, kMotionGroup, "dlj", "Dimensionless jerk", "1", "", 1, kHigh,
     "-(T^3 / peak speed^2) times the integral of the squared second derivative of the speed, mean of the pieces."},
    {kLogJerk, kMotionGroup, "ldlj", "Smoothness (LDLJ)", "1", "", 1, kHigh,
     "Log dimensionless jerk, -ln |DLJ|, mean of the pieces."},
    {kSparc, kMotionGroup, "sparc", "Smoothness (SPARC)", "1", "", 1, kHigh,
     "Spectral arc length of the speed up to 10 Hz, mean of the pieces; near -1.4 for one smooth movement."},
    {kMotionFrequency, kMotionGroup, "motion_frequency_95", "95 % motion frequency", "Hz", "Hz", 1, kLow,
     "Frequency below which 95 % of the power of the speed's deviation from its mean lies."},
    {kForcePeak, kForceGroup, "force_peak", "Peak force", "N", "N", 1, kLow, "Largest force on the hand."},
    {kForceMean, kForceGroup, "force_mean", "Mean force", "N", "N", 1, kLow, "Mean magnitude of the force."},
    {kForceRms, kForceGroup, "force_rms", "RMS force", "N", "N", 1, kLow, "Root mean square of the force."},
    {kImpulse, kForceGroup, "impulse", "Impulse", "N s", "N s", 1, kLow, "Integral of the force's magnitude."},
    {kForceRateRms, kForceGroup, "force_rate_rms", "RMS force rate", "N/s", "N/s", 1, kLow,
     "Root mean square of the change of force."},
    {kForceRatePeak, kForceGroup, "force_rate_peak", "Peak force rate", "N/s", "N/s", 1, kLow,
     "Fastest change of force."},
    {kWork, kForceGroup, "work", "Work on the hand", "J", "mJ", 1e3, kNeither,
     "Integral of force times motion: energy that the motor gave to the hand."},
    {kExcessTime, kForceGroup, "excess_time", "Time with excess force", "s", "s", 1, kLow,
     "Time with a force above the force limit."},
    {kForceDeviation, kForceGroup, "force_deviation", "Variability of force", "N", "N", 1, kLow,
     "Standard deviation of the force's magnitude."},
    {kForceEllipsoid, kForceGroup, "force_ellipsoid", "Force ellipsoid", "N^3", "N³", 1, kLow,
     "Volume of the ellipsoid with the standard deviations of the force along its principal axes."},
    {kOffAxisShare, kForceGroup, "off_axis_share", "Force off the task axis", "1", "%", 100, kLow,
     "Integral of the force across the normal of the tool's surface, over the integral of the force."},
    {kForceSparc, kForceGroup, "force_sparc", "Smoothness of force (SPARC)", "1", "", 1, kHigh,
     "Spectral arc length of the force's magnitude."},
    {kContacts, kContactGroup, "contacts", "Contacts", "1", "", 1, kNeither,
     "Number of times that the tool came into contact; interruptions below 20 ms do not count."},
    {kContactTimeMean, kContactGroup, "contact_time_mean", "Mean contact time", "s", "s", 1, kNeither,
     "Mean duration of a contact."},
    {kContactForcePeak, kContactGroup, "contact_force_peak", "Peak contact force", "N", "N", 1, kLow,
     "Largest force of the environment on the tool."},
    {kContactForceMean, kContactGroup, "contact_force_mean", "Mean contact force", "N", "N", 1, kLow,
     "Mean force of the environment on the tool while in contact."},
    {kContactImpulse, kContactGroup, "contact_impulse", "Contact impulse", "N s", "N s", 1, kLow,
     "Integral of the force of the environment on the tool."},
    {kPenetrationMax, kContactGroup, "penetration_max", "Deepest penetration", "m", "mm", 1e3, kLow,
     "Largest depth of the tool in the environment."},
    {kTracking, kTrackGroup, "tracking_rms", "Hand to tool (RMS)", "m", "mm", 1e3, kLow,
     "Root mean square distance between hand and tool, delay included."},
    {kTrackingNoDelay, kTrackGroup, "tracking_rms_no_delay", "Hand to tool, delay removed", "m", "mm", 1e3, kLow,
     "The same against the tool later by the delay that makes it least."},
    {kTrackingDelay, kTrackGroup, "tracking_delay", "Delay of the tool", "s", "ms", 1e3, kLow,
     "The delay of that least distance."},
    {kJointTracking, kTrackGroup, "joint_tracking_rms", "Joints of hand and slave (RMS)", "rad", "mrad", 1e3, kLow,
     "Root mean square difference of the joints; one prismatic axis: in m."},
    {kReflectionError, kTrackGroup, "reflection_error", "Force reflection error", "N", "N", 1, kLow,
     "Root mean square difference between force on the hand and force of the environment, in contact."},
    {kReflectionErrorShare, kTrackGroup, "reflection_error_share", "The same, of the peak", "1", "%", 100, kLow,
     "Force reflection error over the peak contact force."},
    {kRenderedStiffness, kTrackGroup, "rendered_stiffness", "Stiffness felt", "N/m", "N/m", 1, kHigh,
     "Slope of the force on the hand over the hand's depth beyond the surface, by least squares."},
    {kTransparency, kTrackGroup, "transparency", "Transparency", "1", "", 1, kNeither,
     "Impedance that the hand feels over that of the environment, |Z_t / Z_e|, along the surface's normal: median of "
     "the frequencies from 0.5 to 10 Hz with a coherence above 0.8; ideal is 1."},
    {kDrift, kTrackGroup, "drift", "Drift", "m", "mm", 1e3, kLow,
     "Mean distance between hand and tool after half a second at rest."},
    {kAuthorityShare, kShareGroup, "authority_share", "Authority", "1", "%", 100, kNeither, "Mean authority."},
    {kAuthorityShareContact, kShareGroup, "authority_share_contact", "Authority in contact", "1", "%", 100, kNeither,
     "Mean authority while the tool is in contact."},
    {kWeightedTime, kShareGroup, "weighted_time", "Time, by authority", "s", "s", 1, kNeither,
     "Integral of the authority."},
    {kWeightedPath, kShareGroup, "weighted_path", "Path, by authority", "m", "mm", 1e3, kLow,
     "Path length weighted with the authority."},
    {kWeightedImpulse, kShareGroup, "weighted_impulse", "Contact impulse, by authority", "N s", "N s", 1, kLow,
     "Contact impulse weighted with the authority."},
    {kInterventions, kShareGroup, "interventions", "Interventions", "1", "", 1, kNeither,
     "Number of times that this instructor took the tool from another seat."},
    {kInterventionTime, kShareGroup, "intervention_time", "Time of interventions", "s", "s", 1, kNeither,
     "Duration of these interventions."},
    {kHandoverJump, kShareGroup, "handover_jump", "Jump at a change of authority", "N", "N", 1, kLow,
     "Largest change of force from one tick to the next, from 50 ms before to 50 ms after a change of authority."},
    {kHandoverRate, kShareGroup, "handover_rate", "Force rate at a change of authority", "N/s", "N/s", 1, kLow,
     "Fastest change of the filtered force in the same time."},
    {kPassivityMargin, kPassiveGroup, "passivity_margin", "Passivity margin", "J", "mJ", 1e3, kHigh,
     "Least margin of the energy account so far."},
    {kControllerShare, kPassiveGroup, "controller_share", "Ticks with dissipation", "1", "%", 100, kLow,
     "Share of the ticks in which the channel's end dissipated energy: its damping was active."},
    {kDissipated, kPassiveGroup, "dissipated", "Dissipated energy", "J", "mJ", 1e3, kLow,
     "Energy that the channel's end dissipated in this part."},
    {kRoundTrip50, kLinkGroup, "rtt_p50", "Round trip, median", "s", "ms", 1e3, kLow, "Median of the round trips."},
    {kRoundTrip95, kLinkGroup, "rtt_p95", "Round trip, 95 %", "s", "ms", 1e3, kLow,
     "95th percentile of the round trips, each the median of a sixtieth of a second."},
    {kRoundTrip99, kLinkGroup, "rtt_p99", "Round trip, 99 %", "s", "ms", 1e3, kLow, "99th percentile of the same."},
    {kLossUp, kLinkGroup, "loss_up", "Loss to the server", "1", "%", 100, kLow, "Mean loss of datagrams."},
    {kLossDown, kLinkGroup, "loss_down", "Loss to the client", "1", "%", 100, kLow, "Mean loss of datagrams."},
    {kGapUp, kLinkGroup, "gap_up", "Longest gap to the server", "s", "ms", 1e3, kLow, "Longest time without datagram."},
    {kGapDown, kLinkGroup, "gap_down", "Longest gap to the client", "s", "ms", 1e3, kLow,
     "Longest time without datagram."},
    {kAge99, kLinkGroup, "age_p99", "Age of the samples, 99 %", "s", "ms", 1e3, kLow,
     "Largest 99th percentile of the age of the newest sample."},
    {kGateTrips, kLinkGroup, "gate_trips", "Gate trips", "1", "", 1, kLow,
     "Losses of the link that released the hand."},
    {kLateTicks, kLinkGroup, "late_ticks", "Late ticks", "1", "", 1, kLow, "Late ticks of the device's thread."},
}};

constexpr double kShownMin = 1e-9;  // in the unit of reports; less is rounding

static_assert([] {
  for (std::size_t i = 0; i < kMetricCount; ++i)
    if (static_cast<std::size_t>(kRows[i].metric) != i) return false;
  return true;
}());

constexpr std::array kMainMetrics{
    kTime,      kIdleTime,        kPathLength,      kStraightShare, kLogJerk,          kSparc,
    kForcePeak, kForceMean,       kExcessTime,      kForceRatePeak, kContactForcePeak, kPenetrationMax,
    kTracking,  kTrackingNoDelay, kReflectionError, kHandoverJump,  kAuthorityShare};

}  // namespace

const std::array<MetricRow, kMetricCount>& metric_rows() noexcept { return kRows; }
const MetricRow& row_of(Metric metric) noexcept { return kRows[static_cast<std::size_t>(metric)]; }

std::optional<Metric> metric_named(std::string_view key) noexcept {
  const auto* const found = std::ranges::find(kRows, key, &MetricRow::key);
  return found == kRows.end() ? std::nullopt : std::optional(found->metric);
}

std::span<const Metric> main_metrics() noexcept { return kMainMetrics; }

std::string_view title_of(MetricGroup group) noexcept {
  constexpr std::string_view kTitles[] = {"Motion of the hand",
                                          "Force on the hand",
                                          "Contact of the tool",
                                          "Tracking and transparency",
                                          "Sharing",
                                          "Passivity",
                                          "Link"};
  return kTitles[static_cast<std::size_t>(group)];
}

std::string value_text(const MetricRow& row, double value) {
  if (!std::isfinite(value)) return "–";
  const double shown = value * row.factor;
  if (std::abs(shown) < kShownMin) return "0";
  if (std::abs(shown) >= 1e6 || std::abs(shown) < 1e-3) return format("%.2e", shown);
  const int before = static_cast<int>(std::floor(std::log10(std::abs(shown)) + 1e-12)) + 1;
  return format("%.*f",
                row.si_unit == "1" && row.unit.empty() && shown == std::floor(shown) ? 0 : std::max(0, 3 - before),
                shown);
}

std::string value_with_unit(const MetricRow& row, double value) {
  const std::string text = value_text(row, value);
  return row.unit.empty() || !std::isfinite(value) ? text : text + " " + std::string(row.unit);
}

}  // namespace tandem::netsim::score
