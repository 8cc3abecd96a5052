#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

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

/// Returns the description as JSON: name, version, summary, sources, checks.
[[nodiscard]] nlohmann::ordered_json profile_json(const Profile& profile);
/// Returns description and measured results as JSON. `measured` has minutes, and per direction p5_ms .. max_ms,
/// lost_percent, dropped (by cause); `quality` is that of quality_json.
[[nodiscard]] nlohmann::ordered_json profile_json(const ProfileSource& subject, const ProfilePreview& portrait);

[[nodiscard]] plot::Figure profile_figure(const ProfileSource& subject, const ProfilePreview& portrait);

}  // namespace tandem::netsim
