#pragma once

/// Thresholds and filters of the scores. Every report states them.
namespace tandem::netsim::score {

struct ScoreOptions {
  double authority = 0.5;          ///< a master holds a tool from this authority on [0, 1]
  double position_cutoff_hz = 10;  ///< low-pass of positions, order 4, without phase
  double force_cutoff_hz = 20;     ///< the same for forces
  double spectrum_rate_hz = 100;   ///< speed and force are averaged to at most this rate for smoothness and spectra
  double speed_min = 0.005;        ///< a hand below this speed is idle [m/s]
  double force_contact = 0.05;     ///< a tool is in contact, and a hand feels force, above this force [N]
  double force_limit = 2;          ///< limit of the time with excess force [N]
  double segment_min_s = 0.5;      ///< shorter pieces count in sums, not in smoothness
  double gap_flagged_s = 0.050;    ///< a score is flagged above this gap, and pieces end there
  double missing_flagged = 0.01;   ///< a score is flagged above this share of ticks without a new sample
  double gap_withheld_s = 0.5;     ///< a score is withheld above this gap
  double missing_withheld = 0.10;  ///< and above this share
  double lag_max_s = 0.5;          ///< longest delay in the search for the tracking error without delay
};

}  // namespace tandem::netsim::score
