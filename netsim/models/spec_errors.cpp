#include "netsim/models/spec_errors.h"

#include "common/base/format.h"

namespace tandem::netsim {

std::string SpecErrors::text(Duration d) { return format("%g ms", static_cast<double>(d.count()) / 1e6); }
std::string SpecErrors::text(double value) { return format("%g", value); }

}  // namespace tandem::netsim
