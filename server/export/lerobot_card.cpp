#include "server/export/lerobot_card.h"

#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::server {

std::string lerobot_card(const LerobotDataset& set, const LerobotLayout& layout) {
  std::string text =
      "---\ntask_categories:\n- robotics\ntags:\n- LeRobot\nconfigs:\n- config_name: default\n  data_files: "
      "data/*/*.parquet\n---\n\n# " +
      sanitize(set.task) + "\n\n";
  text += format(
      "%zu lessons recorded by Tandem, %lld frames at %u frames per second, LeRobot %s, without video. A frame covers "
      "%zu ticks of the\nsession; `observation.window` and `action.window` hold the signals at every tick.\n\n",
      set.episodes.size(), static_cast<long long>(set.frames()), layout.fps(), to_text(set.version), layout.window());
  text += "Units are in the names of the numbers. All are in the frame of the scene. NaN: not recorded or not known.\n";
  text += "`observation.gap` is true in frames with ticks that were not recorded.\n";
  text += "`observation.intervention` is true where instructors had more than half of the authority over a tool.\n\n";
  text += "| feature | type | shape | numbers |\n|---|---|---|---|\n";
  for (const LerobotFeature& feature : layout.features()) {
    std::string shape, columns;
    for (const std::size_t n : feature.shape) shape += (shape.empty() ? "" : " x ") + std::to_string(n);
    for (const std::string& name : feature.columns) columns += (columns.empty() ? "" : ", ") + name;
    text += "| `" + feature.name + "` | " + to_text(feature.type) + " | " + shape + " | " + columns + " |\n";
  }
  return text;
}

}  // namespace tandem::server
