#include "client/app/device_list.h"

#include "common/base/format.h"

namespace tandem::client {

std::string fact_line(const hal::DeviceFact& fact) { return format("            %-13s ", fact.about.c_str()) + fact.words + "\n"; }

std::string describe(const hal::Backend& backend, const hal::FoundDevice& device) {
  std::string text = device.about + "\n            --device " + device.words + "\n";
  if (!device.trouble.empty()) text += "            " + device.trouble + "\n";
  text += fact_line({"library", backend.library()});
  if (!device.node.empty())
    text += fact_line({"permission", device.trouble.empty() ? "you may open " + device.node : "none for " + device.node + ", see above"});
  for (const hal::DeviceFact& fact : backend.facts()) text += fact_line(fact);
  return text;
}

}  // namespace tandem::client
