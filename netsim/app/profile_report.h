#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "netsim/app/profile_subject.h"
#include "netsim/plot/svg_plot.h"
#include "netsim/portrait.h"
#include "netsim/portrait_text.h"

namespace tandem::netsim {

/// What a profile says about itself: summary, version, sources, and its parameters as they stand in its file.
[[nodiscard]] std::string profile_heading(const ProfileSubject& subject);

/// What was measured: quantiles beside those promised, loss by cause, the verdict, pictures.
[[nodiscard]] std::string profile_report(const ProfileSubject& subject, const Portrait& portrait,
                                         const PictureStyle& style);

/// The heading for machines: name, version, summary, sources, checks.
[[nodiscard]] nlohmann::ordered_json profile_json(const Profile& profile);
/// Heading and what was measured: `measured` has minutes, and per direction p5_ms .. max_ms, lost_percent, dropped (by
/// cause); `quality` as quality_json says.
[[nodiscard]] nlohmann::ordered_json profile_json(const ProfileSubject& subject, const Portrait& portrait);

[[nodiscard]] plot::Figure profile_figure(const ProfileSubject& subject, const Portrait& portrait);

}  // namespace tandem::netsim
