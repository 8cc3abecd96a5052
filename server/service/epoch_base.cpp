#include "server/service/epoch_base.h"

namespace tandem::server {

void EpochBase::learn() {
  for (const auto& [session, entry] : directory_.catalogue.entries())
    if (entry.spec) take(entry.spec->epoch_base);
  for (const auto& [name, server] : directory_.members()) take(server.epoch_base);
}

void EpochBase::raise() noexcept { base_ = std::min(base_ + kEpochs, kBaseMax); }

ServiceSession EpochBase::on(ServiceSession spec) {
  learn();
  spec.epoch_base = std::max(spec.epoch_base, base_);
  return spec;
}

}  // namespace tandem::server
