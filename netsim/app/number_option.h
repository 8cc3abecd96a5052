#pragma once

#include "common/io/number_option.h"

namespace tandem::netsim {

using io::number_in;
using io::whole_number;

}  // namespace tandem::netsim
