#pragma once

#include <string>
#include <vector>

#include "netsim/app/profile_source.h"
#include "netsim/plot/svg_plot.h"
#include "netsim/profiles/profile_preview.h"
#include "netsim/profiles/profile_preview_text.h"

namespace tandem::netsim {

/// Returns the description of a profile: summary, version, sources, and the parameters as written in its file.
[[nodiscard]] std::string profile_heading(const ProfileSource& subject);

/// Returns the measured results: quantiles beside the promised ones, loss by cause, the verdict, pictures.
[[nodiscard]] std::string profile_report(const ProfileSource& subject, const ProfilePreview& portrait,
                                         const PictureStyle& style);

/// Returns the descriptions as a JSON array: name, version, summary, sources, checks.
[[nodiscard]] std::string profiles_json(const std::vector<Profile>& profiles);
/// Returns description and measured results as JSON. `measured` has minutes, and per direction p5_ms .. max_ms,
/// lost_percent, dropped (by cause); `quality` is that of quality_json.
[[nodiscard]] std::string profile_json(const ProfileSource& subject, const ProfilePreview& portrait, bool interrupted);

[[nodiscard]] plot::Figure profile_figure(const ProfileSource& subject, const ProfilePreview& portrait);

}  // namespace tandem::netsim
