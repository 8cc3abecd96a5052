#pragma once

#include "common/control/plane_estimator.h"
#include "server/session/contact_source.h"

namespace tandem::server {

/// Contact source that estimates the plane touched by a SLAVE seat's device from the device's reports. Without contact
/// it returns no plane, and hands feel nothing. During a contact whose plane is not known yet, the confidence falls to
/// 0 and hands feel the spring to the device.
class EstimatedPlane final : public ContactSource {
 public:
  static constexpr double kConfidenceRate = 5;  ///< rate limit of `confidence` [1/s]
  static constexpr double kDamping = 5;         ///< damping of the plane [N s/m]

  /// @param axes  number of port axes, 1 to 3
  explicit EstimatedPlane(std::size_t axes) noexcept : estimator_(axes) {}
  void find_contacts(const ToolView& tool, LocalContactList& out) noexcept override;
  [[nodiscard]] double confidence() const noexcept override { return confidence_; }
  [[nodiscard]] const control::PlaneEstimator& estimator() const noexcept { return estimator_; }

 private:
  control::PlaneEstimator estimator_;
  double waited_ = 0;  ///< time since the newest sample [s]
  double confidence_ = 1;
};

}  // namespace tandem::server
