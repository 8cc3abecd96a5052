#include "client/app/device_list.h"

#include "common/base/format.h"

namespace tandem::client {

std::string fact_line(const hal::DeviceFact& fact) {
  return format("            %-13s ", fact.topic.c_str()) + fact.text + "\n";
}

std::string finding_line(const DeviceDiagnostics::Finding& finding) {
  static constexpr const char* kMarks[] = {"  ok      ", "  notice  ", "  TROUBLE "};
  return kMarks[static_cast<std::size_t>(finding.kind)] + finding.text + "\n";
}

std::string describe(const hal::Backend& backend, const hal::FoundDevice& device) {
  std::string text = device.description + "\n            --device " + device.spec + "\n";
  if (!device.problem.empty()) text += "            " + device.problem + "\n";
  text += fact_line({"library", backend.library()});
  if (!device.node.empty())
    text += fact_line({"permission", device.problem.empty() ? "you may open " + device.node
                                                            : "none for " + device.node + ", see above"});
  for (const hal::DeviceFact& fact : backend.facts()) text += fact_line(fact);
  return text;
}

}  // namespace tandem::client
