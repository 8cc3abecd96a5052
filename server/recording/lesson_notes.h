#pragma once

#include <cstdint>

#include "common/base/time.h"
#include "proto/spec/lesson.h"
#include "proto/wire/session_telemetry.h"
#include "server/report/audit_event.h"

namespace tandem::server {

/// An audit event as recordings have it.
/// @param elapsed  of the session's clock at the event (SessionClock::elapsed)
[[nodiscard]] LessonEvent lesson_event(const AuditEvent& event, const SceneSpec& scene, Duration elapsed);

/// A seat's link as recordings have it. Real-time safe.
/// @param tick  of the session
[[nodiscard]] LessonLink lesson_link(const wire::WatchedLink& link, std::uint32_t tick) noexcept;

}  // namespace tandem::server
